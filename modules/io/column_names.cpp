#include "modules/io/column_names.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "modules/io/crs.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {
namespace {

using Fields = std::vector<std::string_view>;

/// These roles, and x, y and z where a surveyor's names say them: easting, northing, elevation. Empty without all
/// three.
std::vector<Role> surveyors_roles(const Fields& names, std::vector<Role> roles) {
  constexpr std::pair<std::string_view, Role> known[] = {
      {"easting", Role::x},   {"east", Role::x},   {"northing", Role::y}, {"north", Role::y},
      {"elevation", Role::z}, {"height", Role::z}, {"altitude", Role::z}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower_case(names[i].substr(0, names[i].find_first_of("[( ")));
    for (const auto& [text, role] : known)
      if (roles[i] == Role::none && text == name && std::find(roles.begin(), roles.end(), role) == roles.end())
        roles[i] = role;
  }
  const auto has = [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
  return has(Role::x) && has(Role::y) && has(Role::z) ? roles : std::vector<Role>{};
}

/// The roles if the fields name the columns, with x, y and z among them; else empty.
std::vector<Role> roles_of(const Fields& names) {
  std::vector<Role> roles;
  bool position[3] = {false, false, false};
  Fields plain;
  plain.reserve(names.size());
  for (auto name : names) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    plain.push_back(name);
    Role role = role_of(name);
    if (role == Role::packed_colour || role == Role::source ||
        std::find(roles.begin(), roles.end(), role) != roles.end())
      role = Role::none;
    roles.push_back(role);
    if (role <= Role::z) position[static_cast<std::size_t>(role)] = true;
  }
  if (position[0] && position[1] && position[2]) return roles;
  return surveyors_roles(plain, std::move(roles));
}

/// What stands in brackets behind a name; empty if nothing does.
std::string unit_text(std::string_view name) {
  const std::size_t at = name.find_first_of("[(");
  if (at == std::string_view::npos) return {};
  const std::string_view rest = name.substr(at + 1);
  return lower_case(rest.substr(0, rest.find_first_of("])")));
}

std::optional<double> metres_of(const std::string& unit) {
  constexpr std::pair<std::string_view, double> units[] = {{"m", 1},
                                                           {"metre", 1},
                                                           {"metres", 1},
                                                           {"meter", 1},
                                                           {"meters", 1},
                                                           {"cm", 0.01},
                                                           {"mm", 0.001},
                                                           {"in", 0.0254},
                                                           {"inch", 0.0254},
                                                           {"inches", 0.0254},
                                                           {"ft", 0.3048},
                                                           {"foot", 0.3048},
                                                           {"feet", 0.3048},
                                                           {"us-ft", us_survey_foot},
                                                           {"ftus", us_survey_foot}};
  for (const auto& [name, metres] : units)
    if (unit == name) return metres;
  return std::nullopt;
}

/// Metres per unit of x, y and z, unless their names contradict each other.
std::optional<double> metres_by(const std::vector<std::string>& units, const std::vector<Role>& roles) {
  std::optional<double> found;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const auto metres = roles[i] <= Role::z ? metres_of(units[i]) : std::nullopt;
    if (!metres) continue;
    if (found && *found != *metres) return std::nullopt;
    found = metres;
  }
  return found;
}

/// The names between blanks or commas; a unit on its own belongs to the name before it.
Fields plain_names(std::string_view line, std::vector<std::string>& units) {
  Fields names;
  for (const auto token : tokens_of(line)) {
    const bool is_unit = token.front() == '[' || token.front() == '(';
    if (is_unit && !units.empty()) units.back() = unit_text(token);
    if (is_unit) continue;
    names.push_back(token);
    units.push_back(unit_text(token));
  }
  return names;
}

}  // namespace

Fields tokens_of(std::string_view line) {
  Fields all;
  const auto next = [&] { return next_token(line, Commas::separate); };
  for (auto t = next(); !t.empty() && (all.empty() || !t.starts_with('#')); t = next()) all.push_back(t);
  return all;
}

ColumnNames column_names(std::string_view line, const TextDialect& dialect, std::size_t width) {
  ColumnNames best;
  const auto consider = [&](const Fields& names, const std::vector<std::string>& units) {
    auto roles = roles_of(names);
    if (roles.empty() || (!best.roles.empty() && (best.roles.size() == width || roles.size() != width))) return;
    best.metres_per_unit = metres_by(units, roles);
    best.roles = std::move(roles);
  };
  for (const TextDialect& d : {dialect, TextDialect{'\t'}, TextDialect{';'}, TextDialect{','}}) {
    const Fields names = fields_of(line, d);
    std::vector<std::string> units;
    units.reserve(names.size());
    for (const auto name : names) units.push_back(unit_text(name));
    consider(names, units);
  }
  std::vector<std::string> units;
  const Fields names = plain_names(line, units);
  consider(names, units);
  return best;
}

std::string_view names_in_comments(std::string_view text) {
  std::string_view names;
  for_lines(text, [&](std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.empty()) return true;
    if (!line.starts_with('#') && !line.starts_with("//")) return false;
    line.remove_prefix(std::min(line.find_first_not_of("#/"), line.size()));
    if (!column_names(line, {}, 0).roles.empty()) names = line;
    return true;
  });
  return names;
}

}  // namespace atrium::io
