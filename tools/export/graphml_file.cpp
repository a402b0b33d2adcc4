#include "morsel/tools/export/graphml_file.h"

#include <array>
#include <boost/graph/graphml.hpp>
#include <boost/make_shared.hpp>
#include <boost/property_map/dynamic_property_map.hpp>
#include <cmath>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <utility>

#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/numbers.h"
#include "morsel/mscomplex/graph.h"
#include "morsel/tools/export/complex_nodes.h"

namespace morsel::tools {
namespace {

using Graph = mscomplex::MorseSmaleGraph;
using GraphNode = boost::graph_traits<Graph>::vertex_descriptor;
using GraphEdge = boost::graph_traits<Graph>::edge_descriptor;

constexpr std::array kNodeTypes = {"minimum", "saddle", "maximum", "cap"};  // by NodeKind

std::string text_of(const std::string& value) { return value; }
std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(core::Index value) { return std::to_string(value); }
std::string text_of(double value) { return core::shortest(value); }

/// A property whose value at a node, an edge or the graph is function(of). Boost's own are written with six
/// digits.
template <class Of, class Function>
class GraphProperty : public boost::dynamic_property_map {
 public:
  explicit GraphProperty(Function function) : function_(std::move(function)) {}
  boost::any get(const boost::any& key) override { return function_(boost::any_cast<Of>(key)); }
  std::string get_string(const boost::any& key) override {
    return text_of(function_(boost::any_cast<Of>(key)));
  }
  void put(const boost::any&, const boost::any&) override {
    throw std::logic_error("properties of a complex are for reading");
  }
  const std::type_info& key() const override { return typeid(Of); }
  const std::type_info& value() const override { return typeid(decltype(function_(std::declval<Of>()))); }

 private:
  Function function_;
};

template <class Of, class Function>
void add_property(boost::dynamic_properties& properties, const char* name, Function function) {
  properties.insert(name, boost::make_shared<GraphProperty<Of, Function>>(std::move(function)));
}

}  // namespace

void write_graphml_file(const core::FileTarget& target, const ComplexFile& file,
                        const Provenance& provenance) {
  const Graph graph = mscomplex::graph(file.complex);
  const double extent = file.field.extent();
  const core::TriangleMesh& mesh = file.loaded.mesh;
  const auto finite = [extent](double persistence) {
    return std::isfinite(persistence) ? persistence : extent;
  };
  const auto of_node = [&](GraphNode n) { return persistence_of(graph[n], file.persistence); };
  const auto of_edge = [&](const GraphEdge& e) {
    return std::abs(graph[boost::source(e, graph)].value - graph[boost::target(e, graph)].value);
  };
  boost::dynamic_properties properties;
  add_property<Graph*>(properties, "provenance", [&](const Graph*) { return provenance.json(); });
  add_property<GraphNode>(properties, "type", [&](GraphNode n) {
    if (n % 1024 == 0) core::throw_if_stopped();
    return std::string(kNodeTypes[static_cast<std::size_t>(graph[n].kind)]);
  });
  add_property<GraphNode>(properties, "cell", [&](GraphNode n) { return graph[n].cell; });
  add_property<GraphNode>(properties, "vertex", [&](GraphNode n) {
    return file.loaded.source.numbering.input_vertex(graph[n].vertex);
  });
  add_property<GraphNode>(properties, "value",
                          [&](GraphNode n) { return finite_value(graph[n], file.field); });
  add_property<GraphNode>(properties, "persistence", [&](GraphNode n) { return finite(of_node(n)); });
  add_property<GraphNode>(properties, "essential", [&](GraphNode n) { return !std::isfinite(of_node(n)); });
  constexpr std::array kAxes = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    add_property<GraphNode>(properties, kAxes[static_cast<std::size_t>(axis)],
                            [&, axis](GraphNode n) { return place_of(mesh, graph[n])[axis]; });
  add_property<GraphEdge>(properties, "kind", [&](const GraphEdge& e) {
    if (graph[e].arc % 1024 == 0) core::throw_if_stopped();
    return std::string(graph[e].kind == mscomplex::ArcKind::descending ? "descending" : "ascending");
  });
  add_property<GraphEdge>(properties, "persistence", [&](const GraphEdge& e) { return finite(of_edge(e)); });
  add_property<GraphEdge>(properties, "essential",
                          [&](const GraphEdge& e) { return !std::isfinite(of_edge(e)); });

  core::FileWriter writer(target, core::Sync::never);
  boost::write_graphml(writer.stream(), graph, properties);
  writer.commit();
}

}  // namespace morsel::tools
