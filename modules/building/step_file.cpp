#include "modules/building/step_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "graph/api/error.hpp"
#include "graph/api/walk.hpp"

namespace atrium::building {
namespace {

constexpr char32_t replacement = 0xFFFD;

/// The next character of a UTF-8 text, which is not at its end; `replacement` for a byte that begins none.
char32_t next_character(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at++);
  if (first < 0x80) return first;
  const std::size_t more = first >= 0xF0 && first < 0xF8 ? 3 : first >= 0xE0 ? 2 : first >= 0xC2 ? 1 : 0;
  if (more == 0 || first >= 0xF8 || at + more > text.size()) return replacement;
  char32_t code = first & (0x3FU >> more);
  for (std::size_t i = 0; i < more; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80) return replacement;
    code = code << 6U | (byte(at + i) & 0x3FU);
  }
  constexpr char32_t least[] = {0x80, 0x800, 0x10000};
  if (code < least[more - 1] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return replacement;
  at += more;
  return code;
}

}  // namespace

namespace step {

StepValue text(std::string_view utf8) {
  std::string result = "'";
  char open = 0;  // '2' or '4' within \X2\ or \X4\.
  const auto set_open = [&](char wanted) {
    if (open == wanted) return;
    if (open != 0) result += "\\X0\\";
    if (wanted != 0) result += fmt::format("\\X{}\\", wanted);
    open = wanted;
  };
  for (std::size_t at = 0; at < utf8.size();) {
    const char32_t c = next_character(utf8, at);
    set_open(c >= 0x20 && c < 0x7F ? '\0' : c < 0x10000 ? '2' : '4');
    if (open != 0)
      result += open == '2' ? fmt::format("{:04X}", static_cast<std::uint32_t>(c))
                            : fmt::format("{:08X}", static_cast<std::uint32_t>(c));
    else if (c == '\'' || c == '\\')
      result += {static_cast<char>(c), static_cast<char>(c)};
    else
      result += static_cast<char>(c);
  }
  set_open(0);
  return StepValue(result + "'");
}

StepValue real(double value) {
  if (!std::isfinite(value)) throw Error("a number for the IFC file is not finite");
  std::string result = fmt::format("{:.9f}", value);
  result.erase(result.find_last_not_of('0') + 1);
  if (result == "-0.") result = "0.";
  return StepValue(result);
}

StepValue whole(std::int64_t value) { return StepValue(std::to_string(value)); }
StepValue truth(bool value) { return StepValue(std::string(value ? ".T." : ".F.")); }
StepValue choice(std::string_view name) { return StepValue(fmt::format(".{}.", name)); }
StepValue none() { return StepValue(std::string("$")); }
StepValue derived() { return StepValue(std::string("*")); }

StepValue list(const std::vector<StepValue>& values) {
  std::string result = "(";
  for (const auto& value : values) {
    if (result.size() > 1) result += ',';
    result += value.text;
  }
  return StepValue(result + ")");
}

StepValue refs(const std::vector<StepRef>& values) { return list({values.begin(), values.end()}); }

StepValue reals(const std::vector<double>& values) {
  std::vector<StepValue> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(real(value));
  return list(texts);
}

StepValue typed(std::string_view type, const StepValue& value) {
  return StepValue(fmt::format("{}({})", type, value.text));
}

}  // namespace step

StepRef StepFile::add(std::string_view type, const Fields& fields) {
  ++last_;
  data_ += fmt::format("#{}={}{};\n", last_, type, step::list(fields).text);
  return {last_};
}

StepRef StepFile::shared(std::string_view type, const Fields& fields) {
  std::string key = std::string(type) + step::list(fields).text;
  const auto [entry, fresh] = known_.try_emplace(std::move(key), 0);
  if (fresh) {
    ++last_;
    data_ += fmt::format("#{}={};\n", last_, entry->first);
    entry->second = last_;
  }
  return {entry->second};
}

std::string StepFile::contents(std::string_view header) const {
  return fmt::format("ISO-10303-21;\nHEADER;\n{}ENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n", header, data_);
}

std::string global_id(std::string_view key) {
  constexpr std::string_view digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  std::string hex = content_hash(std::string(key));  // 32 hexadecimal digits
  hex[12] = '8';                                     // RFC 9562: a UUID of a kind of one's own
  const unsigned variant = static_cast<unsigned>(std::stoul(hex.substr(16, 1), nullptr, 16));
  hex[16] = "89ab"[variant & 3U];
  const auto bits = [&](std::size_t from, std::size_t count) {
    return std::stoul(hex.substr(from, count), nullptr, 16);
  };
  // The first byte makes two characters, then three bytes make four.
  std::string result{digits[bits(0, 2) >> 6U], digits[bits(0, 2) & 63U]};
  for (std::size_t at = 2; at < 32; at += 6) {
    const unsigned long group = bits(at, 6);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) result += digits[group >> shift & 63U];
  }
  return result;
}

}  // namespace atrium::building
