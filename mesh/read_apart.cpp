#include "mesh/read_apart.h"

#include <cstring>
#include <new>
#include <string_view>
#include <type_traits>

#include <sys/resource.h>
#include <unistd.h>

#include "base/errors.h"
#include "mesh/run_apart.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

class Writer {
 public:
  template <typename T>
  void put(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Eigen::Vector3d>);
    put_bytes(values.data(), values.size(), sizeof(T));
  }
  void put(std::string_view text) { put_bytes(text.data(), text.size(), 1); }
  void put(std::size_t number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void put_bytes(const void* data, std::size_t count, std::size_t size) {
    put(count);
    bytes_.append(static_cast<const char*>(data), count * size);
  }
  std::string bytes_;
};

class Taker {
 public:
  explicit Taker(std::string_view bytes) : bytes_(bytes) {}

  std::size_t number() {
    std::size_t value = 0;
    std::memcpy(&value, piece(1, sizeof value), sizeof value);
    return value;
  }
  template <typename T>
  void take(std::vector<T>& values) {
    const std::size_t count = number();
    const char* data = piece(count, sizeof(T));
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), data, count * sizeof(T));
  }
  std::string text() {
    const std::size_t size = number();
    return {piece(size, 1), size};
  }
  [[nodiscard]] bool is_empty() const { return bytes_.empty(); }

 private:
  const char* piece(std::size_t count, std::size_t size) {
    if (count > bytes_.size() / size) throw base::InputError("is not a whole mesh");
    const char* data = bytes_.data();
    bytes_.remove_prefix(count * size);
    return data;
  }
  std::string_view bytes_;
};

constexpr char kMesh = 'm';
constexpr char kInputError = 'i';
constexpr char kReadError = 'r';
constexpr char kUsageError = 'u';
constexpr char kNoTimeStep = 't';

}  // namespace

std::string to_bytes(const MeshData& mesh) {
  Writer out;
  out.put(mesh.points);
  out.put(mesh.types);
  out.put(mesh.offsets);
  out.put(mesh.connectivity);
  out.put(mesh.fields.size());
  for (const Field& field : mesh.fields) {
    out.put(field.name);
    out.put(static_cast<std::size_t>(field.location));
    out.put(static_cast<std::size_t>(field.components));
    out.put(field.values);
  }
  out.put(mesh.notes.size());
  for (const std::string& note : mesh.notes) out.put(note);
  return out.take();
}

MeshData from_bytes(std::string_view bytes) {
  Taker in(bytes);
  MeshData mesh;
  in.take(mesh.points);
  in.take(mesh.types);
  in.take(mesh.offsets);
  in.take(mesh.connectivity);
  for (std::size_t left = in.number(); left > 0; --left) {
    Field field;
    field.name = in.text();
    field.location = static_cast<Location>(in.number());
    field.components = static_cast<int>(in.number());
    in.take(field.values);
    mesh.fields.push_back(std::move(field));
  }
  for (std::size_t left = in.number(); left > 0; --left) mesh.notes.push_back(in.text());
  if (!in.is_empty()) throw base::InputError("is not a whole mesh");
  return mesh;
}

MeshData read_apart(const std::string& file, const std::function<MeshData()>& read,
                    unsigned seconds) {
  const Apart apart = run_apart(
      [&] {
        const auto memory = static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) *
                            static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
        const rlimit limit = {memory, memory};
        ::setrlimit(RLIMIT_AS, &limit);
        try {
          return kMesh + to_bytes(read());
        } catch (const base::ReadError& error) {
          return kReadError + std::string(error.what());
        } catch (const NoTimeStepError& error) {
          return kNoTimeStep + std::to_string(error.steps()) + ' ' + error.what();
        } catch (const base::UsageError& error) {
          return kUsageError + std::string(error.what());
        } catch (const std::bad_alloc&) {
          return kInputError + std::string("takes more memory than there is");
        } catch (const std::exception& error) {
          return kInputError + std::string(error.what());
        }
      },
      seconds, "reading");
  if (!apart.ending.empty() || apart.result.empty()) {
    throw base::ReadError(file, "is damaged: the library that reads such files " +
                                    (apart.ending.empty() ? "returned nothing" : apart.ending));
  }
  const std::string_view rest = std::string_view(apart.result).substr(1);
  if (apart.result[0] == kMesh) return from_bytes(rest);
  // The message begins with the file's name, which ReadError adds.
  const std::string head = file + ": ";
  const std::string message(rest.starts_with(head) ? rest.substr(head.size()) : rest);
  if (apart.result[0] == kReadError) throw base::ReadError(file, message);
  if (apart.result[0] == kUsageError) throw base::UsageError(message);
  if (apart.result[0] == kNoTimeStep) {
    const std::size_t steps_end = rest.find(' ');
    throw NoTimeStepError(std::string(rest.substr(steps_end + 1)),
                          std::stoul(std::string(rest.substr(0, steps_end))));
  }
  throw base::InputError(message);
}

}  // namespace tetraglass::mesh
