#include "include_circles.h"

#include <algorithm>
#include <map>
#include <set>

#include "include_arrows.h"

namespace palpa::house {
namespace {

/// Who needs whom, and a pair of files that shows it.
using Graph = std::map<std::string, std::map<std::string, std::string>>;

std::string folderOf(const std::string& path) { return path.substr(0, path.rfind('/')); }

template <typename NodeOf>
Graph graphOf(const std::vector<SourceFile>& tree, bool headers_only, const NodeOf& node) {
  std::set<std::string> known;
  for (const SourceFile& file : tree)
    if (file.isProduct()) known.insert(file.path);
  Graph graph;
  for (const SourceFile& file : tree) {
    if (!known.count(file.path) || (headers_only && !file.path.ends_with(".h"))) continue;
    for (const auto& [header, quoted] : includesOf(file.text)) {
      const std::string path = pathOfHeader(file.path, header);
      if (!quoted || !known.count(path) || node(path) == node(file.path)) continue;
      graph[node(file.path)].emplace(node(path), file.path + " includes " + path);
    }
  }
  return graph;
}

/// Walks on from `at`; where the way comes back to one of its own nodes there is a circle.
struct Walk {
  const Graph& graph;
  std::vector<std::string> way;
  std::set<std::string> finished;
  std::vector<std::string> circles;

  void from(const std::string& at) {
    const auto before = std::find(way.begin(), way.end(), at);
    if (before != way.end()) return addCircle(before);
    if (!finished.insert(at).second) return;
    way.push_back(at);
    if (const auto next = graph.find(at); next != graph.end())
      for (const auto& [to, why] : next->second) from(to);
    way.pop_back();
  }

  void addCircle(std::vector<std::string>::const_iterator begin) {
    std::string names, reasons;
    for (auto node = begin; node != way.end(); ++node) {
      const std::string& to = node + 1 == way.end() ? *begin : *(node + 1);
      names += *node + " -> ";
      reasons += (reasons.empty() ? ": " : ", ") + graph.at(*node).at(to);
    }
    circles.push_back(names + *begin + reasons);
  }
};

std::vector<std::string> circlesOf(const Graph& graph) {
  Walk walk{graph, {}, {}, {}};
  for (const auto& [node, next] : graph) walk.from(node);
  return walk.circles;
}

}  // namespace

std::vector<std::string> folderCircles(const std::vector<SourceFile>& tree) {
  return circlesOf(graphOf(tree, false, folderOf));
}

std::vector<std::string> headerCircles(const std::vector<SourceFile>& tree) {
  return circlesOf(graphOf(tree, true, [](const std::string& path) { return path; }));
}

}  // namespace palpa::house
