#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace atrium::building {

/// An instance as it stands in a STEP file: its fields' text, of lists too.
struct StepInstance {
  std::string type;
  std::vector<std::string> fields;
};
using StepInstances = std::map<std::uint32_t, StepInstance>;

/// Reads the instances of an ISO 10303-21 file. Throws Error (with the line) for what is no such file: strings that are
/// not closed or not ASCII, escapes that are none, numbers without a point or exponent in odd places, an id twice.
StepInstances read_step(std::string_view text);

/// Throws Error that names the instance if one has a type that io.write_ifc does not write, too few or too many fields,
/// a reference to what is not there, or a GlobalId that is none or that another has too.
void check_ifc(const StepInstances& instances);

/// The UTF-8 text of a string field.
std::string text_of(std::string_view field);
/// The ids in a field: of a reference, or of a list of them.
std::vector<std::uint32_t> refs_of(std::string_view field);

}  // namespace atrium::building
