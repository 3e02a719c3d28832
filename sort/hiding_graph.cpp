#include "sort/hiding_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tetraglass::sort {
namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

// Tarjan's search, with the stack of calls written out.
class Search {
 public:
  explicit Search(const HidingGraph& graph)
      : graph_(graph),
        number_(graph.size(), kUnseen),
        lowest_(graph.size()),
        next_(graph.size()),
        on_path_(graph.size(), false) {
    for (std::uint32_t cell = 0; cell < graph.size(); ++cell) {
      if (number_[cell] == kUnseen) run(cell);
    }
    // A component is complete only after all those that hide it.
    std::reverse(components_.begin(), components_.end());
  }

  std::vector<std::vector<std::uint32_t>> components_;

 private:
  void enter(std::uint32_t cell) {
    number_[cell] = lowest_[cell] = count_++;
    next_[cell] = graph_.offsets[cell];
    path_.push_back(cell);
    on_path_[cell] = true;
    calls_.push_back(cell);
  }

  void run(std::uint32_t root) {
    enter(root);
    while (!calls_.empty()) {
      const std::uint32_t cell = calls_.back();
      if (next_[cell] < graph_.offsets[cell + 1]) {
        const std::uint32_t front = graph_.fronts[next_[cell]++];
        if (number_[front] == kUnseen) {
          enter(front);
        } else if (on_path_[front]) {
          lowest_[cell] = std::min(lowest_[cell], number_[front]);
        }
        continue;
      }
      calls_.pop_back();
      if (!calls_.empty()) {
        lowest_[calls_.back()] = std::min(lowest_[calls_.back()], lowest_[cell]);
      }
      if (lowest_[cell] == number_[cell]) close(cell);
    }
  }

  void close(std::uint32_t root) {
    auto& component = components_.emplace_back();
    std::uint32_t cell = kUnseen;
    do {
      cell = path_.back();
      path_.pop_back();
      on_path_[cell] = false;
      component.push_back(cell);
    } while (cell != root);
  }

  const HidingGraph& graph_;
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> lowest_;
  std::vector<std::uint32_t> next_;
  std::vector<bool> on_path_;
  std::vector<std::uint32_t> path_;
  std::vector<std::uint32_t> calls_;
  std::uint32_t count_ = 0;
};

// Orders the cells of one component; `behind` counts, for each of them, the cells left in the
// component that it hides.
void break_ring(const HidingGraph& graph, std::vector<std::uint32_t>& component,
                std::span<const double> depths, const std::vector<std::uint32_t>& component_of,
                std::vector<std::uint32_t>& behind, std::vector<std::uint32_t>& order) {
  std::sort(component.begin(), component.end(), [&](std::uint32_t a, std::uint32_t b) {
    return depths[a] != depths[b] ? depths[a] > depths[b] : a < b;
  });
  const std::uint32_t mine = component_of[component.front()];
  const auto in_component = [&](std::uint32_t cell) { return component_of[cell] == mine; };
  for (const std::uint32_t cell : component) {
    for (const std::uint32_t front : graph.fronts_of(cell)) {
      if (in_component(front)) ++behind[front];
    }
  }
  constexpr std::uint32_t kDone = kUnseen;
  std::vector<std::uint32_t> ready;
  const auto emit = [&](std::uint32_t cell) {
    order.push_back(cell);
    behind[cell] = kDone;
    for (const std::uint32_t front : graph.fronts_of(cell)) {
      if (in_component(front) && behind[front] != kDone && --behind[front] == 0) {
        ready.push_back(front);
      }
    }
  };
  for (const std::uint32_t farthest : component) {
    if (behind[farthest] == kDone) continue;
    emit(farthest);
    while (!ready.empty()) {
      const std::uint32_t cell = ready.back();
      ready.pop_back();
      emit(cell);
    }
  }
}

}  // namespace

HidingGraph make_graph(std::size_t size, std::span<const Relation> relations) {
  HidingGraph graph;
  graph.offsets.assign(size + 1, 0);
  for (const Relation& relation : relations) ++graph.offsets[relation.back + 1];
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  graph.fronts.resize(relations.size());
  std::vector<std::uint32_t> places(graph.offsets.begin(), graph.offsets.end() - 1);
  for (const Relation& relation : relations) graph.fronts[places[relation.back]++] = relation.front;
  return graph;
}

std::vector<std::vector<std::uint32_t>> strong_components(const HidingGraph& graph) {
  return std::move(Search(graph).components_);
}

ResolvedOrder resolve(const HidingGraph& graph, std::span<const double> depths) {
  ResolvedOrder result;
  std::vector<std::vector<std::uint32_t>> components = strong_components(graph);
  std::vector<std::uint32_t> component_of(graph.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    for (const std::uint32_t cell : components[i]) {
      component_of[cell] = static_cast<std::uint32_t>(i);
    }
  }
  std::vector<std::uint32_t> behind(graph.size(), 0);
  for (auto& component : components) {
    if (component.size() == 1) {
      result.cells.push_back(component.front());
      continue;
    }
    ++result.cycles;
    result.cyclic_cells.insert(result.cyclic_cells.end(), component.begin(), component.end());
    break_ring(graph, component, depths, component_of, behind, result.cells);
  }
  return result;
}

}  // namespace tetraglass::sort
