#include "image/huffman.h"

#include <algorithm>
#include <vector>

namespace facemap {
namespace {

/// A symbol, or two nodes joined.
struct Node {
  std::uint64_t count;
  std::size_t parent;
};

/// Huffman 1952 with two queues: the symbols by ascending count, and the joined nodes, which come about in that order.
/// Nodes: first the symbols as given.
void build_tree(std::vector<Node>& nodes) {
  const std::size_t symbols = nodes.size();
  std::size_t symbol = 0, joined = symbols;
  const auto take = [&](std::size_t parent) {
    const bool takes_symbol =
        symbol < symbols && (joined == nodes.size() || nodes[symbol].count <= nodes[joined].count);
    Node& node = nodes[takes_symbol ? symbol++ : joined++];
    node.parent = parent;
    return node.count;
  };
  while (nodes.size() < 2 * symbols - 1) {
    const std::size_t parent = nodes.size();
    const std::uint64_t first = take(parent), second = take(parent);
    nodes.push_back({first + second, 0});
  }
}

}  // namespace

void find_code_lengths(std::span<const std::uint32_t> counts, unsigned most, std::span<std::uint8_t> lengths) {
  std::fill(lengths.begin(), lengths.end(), std::uint8_t{0});
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) order.push_back(i);
  }
  if (order.size() < 2) {
    for (const std::size_t symbol : order) lengths[symbol] = 1;
    return;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return counts[a] < counts[b]; });
  // Counts that differ less make a flatter tree; in the end all are equal.
  for (unsigned shift = 0;; ++shift) {
    std::vector<Node> nodes;
    for (const std::size_t symbol : order) nodes.push_back({std::max(1u, counts[symbol] >> shift), 0});
    build_tree(nodes);
    std::vector<unsigned> depths(nodes.size(), 0);
    for (std::size_t i = nodes.size() - 1; i-- > 0;) depths[i] = depths[nodes[i].parent] + 1;
    if (*std::max_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(order.size())) > most) continue;
    for (std::size_t i = 0; i < order.size(); ++i) lengths[order[i]] = static_cast<std::uint8_t>(depths[i]);
    return;
  }
}

}  // namespace facemap
