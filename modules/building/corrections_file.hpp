#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// The file that building.correct reads: a list of corrections, each with its keys, all with their places in the file.
namespace atrium::building {

struct CorrectionPlace {
  std::string file;
  int line = 0, column = 0;  ///< from 1; 0: the file as a whole
};

/// Throws Error "FILE:LINE:COLUMN: problem".
[[noreturn]] void refuse(const CorrectionPlace& place, const std::string& problem, const std::string& help = {});

enum class CorrectionKeyKind { text, texts, length, whole, plan_place, near, yes_or_no, opening_kind, corner };

/// What a key may hold, wherever it may stand.
struct CorrectionKey {
  std::string_view name;
  CorrectionKeyKind kind{};
  double least = 0, most = 0;  ///< of lengths, metres
};
/// A correction's name, its keys in order, and which of them it needs.
struct CorrectionRule {
  std::string_view name;
  std::vector<std::string_view> required, optional;
  std::vector<std::string_view> one_of;        ///< exactly one of these is given
  std::vector<std::string_view> at_least_one;  ///< of these
  std::vector<std::string_view> named_by;      ///< at least one of these optional keys is given
  std::size_t things = 1;                      ///< how many places `near` has: as many as things are named
};
const std::vector<CorrectionKey>& correction_keys();
const std::vector<CorrectionRule>& correction_rules();

/// A key's value: which member holds it follows from its kind.
struct CorrectionValue {
  CorrectionPlace place;
  std::string text;                         ///< text, opening_kind, corner
  std::vector<std::string> texts;           ///< texts
  double number = 0;                        ///< length (metres), whole
  std::vector<double> numbers;              ///< plan_place: two or three, in the scan's unit and frame
  std::vector<std::vector<double>> places;  ///< near: of each thing, two or three
  bool yes = false;                         ///< yes_or_no
};

class Correction {
 public:
  std::string name;
  CorrectionPlace place;
  std::map<std::string, CorrectionValue, std::less<>> values;

  bool has(std::string_view key) const { return values.find(key) != values.end(); }
  const CorrectionValue& at(std::string_view key) const;  ///< that is there
  const std::string& text(std::string_view key) const { return at(key).text; }
  double number(std::string_view key) const { return at(key).number; }
  double number_or(std::string_view key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  bool yes(std::string_view key) const { return has(key) && at(key).yes; }
  /// Throws Error at the key's place, or at the correction's where the key is not given.
  [[noreturn]] void fail(std::string_view key, const std::string& problem, const std::string& help = {}) const;
};

/// All corrections of a file. Throws Error, naming line and column: no YAML, a version that is not known, an unknown
/// correction or key, a key that is missing or given twice, a value of the wrong kind or out of its bounds.
std::vector<Correction> read_corrections(const std::string& file);

}  // namespace atrium::building
