#include "mesh/decompress.h"

#include <algorithm>

#include <bzlib.h>
#include <zlib.h>

#include "base/errors.h"

namespace tetraglass::mesh {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20U;

/// Calls `step(input left, room)` (which returns whether to go on, and moves both on) until there
/// are `most` bytes; the result grows as they come, whatever a file claims to hold.
template <typename Stream, typename Step>
std::string unpack(Stream& stream, std::string_view packed, std::size_t most, const Step& step) {
  std::string result;
  bool more = true;
  while (more && result.size() < most) {
    const std::size_t before = result.size();
    result.resize(before + std::min(kPiece, most - before));
    stream.next_out = reinterpret_cast<decltype(stream.next_out)>(result.data() + before);
    stream.avail_out = static_cast<unsigned>(result.size() - before);
    while (more && stream.avail_out > 0) {
      if (stream.avail_in == 0) {
        const std::size_t next = std::min<std::size_t>(packed.size(), kPiece);
        stream.next_in = reinterpret_cast<decltype(stream.next_in)>(
            const_cast<char*>(packed.data()));  // NOLINT: both libraries only read it
        stream.avail_in = static_cast<unsigned>(next);
        packed.remove_prefix(next);
      }
      const unsigned room = stream.avail_out;
      const bool has_input = stream.avail_in > 0;
      more = step();
      if (more && !has_input && stream.avail_out == room) {
        throw base::InputError("is cut off: its packed values end too early");
      }
    }
    result.resize(result.size() - stream.avail_out);
  }
  return result;
}

}  // namespace

std::string gunzip(std::string_view packed, std::size_t most) {
  z_stream stream{};
  constexpr int kGzipOrZlib = 15 + 32;
  if (inflateInit2(&stream, kGzipOrZlib) != Z_OK) throw base::InputError("cannot be unpacked");
  struct Ender {
    z_stream* stream;
    ~Ender() { inflateEnd(stream); }
  } const ender{&stream};
  return unpack(stream, packed, most, [&] {
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_STREAM_END) return false;
    if (status != Z_OK && status != Z_BUF_ERROR) {
      throw base::InputError("is damaged: its packed values cannot be unpacked by zlib");
    }
    return true;
  });
}

std::string bunzip2(std::string_view packed, std::size_t most) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw base::InputError("cannot be unpacked");
  struct Ender {
    bz_stream* stream;
    ~Ender() { BZ2_bzDecompressEnd(stream); }
  } const ender{&stream};
  return unpack(stream, packed, most, [&] {
    const int status = BZ2_bzDecompress(&stream);
    if (status == BZ_STREAM_END) return false;
    if (status != BZ_OK) {
      throw base::InputError("is damaged: its packed values cannot be unpacked by bzip2");
    }
    return true;
  });
}

}  // namespace tetraglass::mesh
