#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

/// Files of ISO 10303-21 ("STEP"), the clear text that IFC is written in.
namespace atrium::building {

/// An instance: #12. Of id 0: none, written as $.
struct StepRef {
  std::uint32_t id = 0;
  explicit operator bool() const { return id != 0; }
};

/// A value as it stands in the file.
struct StepValue {
  std::string text;
  StepValue(StepRef ref) : text(ref ? "#" + std::to_string(ref.id) : "$") {}  // NOLINT(google-explicit-constructor)
  explicit StepValue(std::string as_it_stands) : text(std::move(as_it_stands)) {}
};

namespace step {

/// 'text' with apostrophes and backslashes doubled; what is not printable ASCII as \X2\…\X0\ (UTF-16) or \X4\…\X0\.
/// The input is UTF-8; bytes that are none become U+FFFD.
StepValue text(std::string_view utf8);
/// To a thousandth of a micrometre, always with a point. Throws Error if the number is not finite.
StepValue real(double value);
StepValue whole(std::int64_t value);
StepValue truth(bool value);              ///< .T. or .F.
StepValue choice(std::string_view name);  ///< .NAME.
StepValue none();                         ///< $
StepValue derived();                      ///< *
StepValue list(const std::vector<StepValue>& values);
StepValue refs(const std::vector<StepRef>& values);
StepValue reals(const std::vector<double>& values);
StepValue typed(std::string_view type, const StepValue& value);  ///< TYPE(value)

}  // namespace step

/// Collects the instances of a file.
class StepFile {
 public:
  using Fields = std::vector<StepValue>;
  StepRef add(std::string_view type, const Fields& fields);
  /// The same instance for the same content.
  StepRef shared(std::string_view type, const Fields& fields);
  /// The whole file; `header` are the lines between HEADER; and ENDSEC;.
  std::string contents(std::string_view header) const;
  std::uint32_t size() const { return last_; }

 private:
  std::string data_;
  std::uint32_t last_ = 0;
  std::unordered_map<std::string, std::uint32_t> known_;
};

/// The 22 characters of an IFC GlobalId for whatever `key` names: always the same for the same key.
std::string global_id(std::string_view key);

}  // namespace atrium::building
