#pragma once
#include <initializer_list>
#include <string_view>
#include <vector>

/// Well-known text (WKT 1 and 2) of coordinate reference systems: nodes NAME[part,part,…], in which parts are nodes,
/// numbers and "texts".
namespace atrium::wkt {

/// The text without the blanks and control characters around it.
std::string_view without_blanks(std::string_view text);

/// Where the node NAME[ begins; npos: there is none. A longer name's end does not count.
std::size_t find_node(std::string_view wkt, std::string_view name);

/// The node from its name to its closing bracket; to the end where that is lacking.
std::string_view node_at(std::string_view wkt, std::size_t begin);

/// What stands right within a node, in its order; of one that is cut off what is left of it. Empty for what is no node.
std::vector<std::string_view> parts_of(std::string_view node);

/// Whether it is a node with that name.
bool is_node(std::string_view part, std::string_view name);

/// The first node with any of these names; empty: there is none.
std::string_view first_node(std::string_view wkt, std::initializer_list<std::string_view> names);

}  // namespace atrium::wkt
