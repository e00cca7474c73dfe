#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace atrium::test {

/// Makes LAS files of any version and record type, with anything wrong.
class LasBuilder {
 public:
  int minor = 2, type = 0, extra = 0;
  double scale = 0.001, offset = 0;
  std::string records;  ///< the points' bytes, as add() makes them
  std::uint64_t points = 0;

  struct Point {
    std::int32_t x = 0, y = 0, z = 0;
    std::uint16_t intensity = 0;
    std::uint8_t classification = 0;
    bool withheld = false;
    std::uint16_t red = 0, green = 0, blue = 0;
  };

  template <class T>
  static void number(std::string& to, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    to.append(raw, sizeof(T));
  }
  static std::string text(std::string value, std::size_t size) {
    value.resize(size);
    return value;
  }

  LasBuilder& add(const Point& p) {
    std::string r;
    for (const std::int32_t v : {p.x, p.y, p.z}) number(r, v);
    number(r, p.intensity);
    if (type < 6) {
      r += '\x09';
      r += static_cast<char>(p.classification | (p.withheld ? 128 : 0));
      r += std::string(4, '\5');
      if (type == 1 || type >= 3) number(r, 1234.5);
    } else {
      r += '\x11';
      r += static_cast<char>(p.withheld ? 4 : 0);
      r += static_cast<char>(p.classification);
      r += std::string(5, '\5');
      number(r, 1234.5);
    }
    if (type == 2 || type == 3 || type == 5 || type == 7 || type == 8 || type == 10)
      for (const std::uint16_t v : {p.red, p.green, p.blue}) number(r, v);
    constexpr std::size_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    r.resize(sizes[type] + static_cast<std::size_t>(extra), '\7');
    records += r;
    ++points;
    return *this;
  }
  /// A variable length record.
  LasBuilder& describe(const std::string& user, std::uint16_t id, const std::string& data) {
    number<std::uint16_t>(descriptions_, 0);
    descriptions_ += text(user, 16);
    number(descriptions_, id);
    number(descriptions_, static_cast<std::uint16_t>(data.size()));
    descriptions_ += text("of a test", 32) + data;
    ++described_;
    return *this;
  }

  std::string file() const {
    const std::uint16_t size = minor < 3 ? 227 : minor == 3 ? 235 : 375;
    constexpr std::size_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    std::string h = "LASF" + std::string(20, '\0');
    h += '\1';
    h += static_cast<char>(minor);
    h += std::string(68, '\0');
    number(h, size);
    number(h, static_cast<std::uint32_t>(size + descriptions_.size()));
    number(h, described_);
    h += static_cast<char>(type);
    number(h, static_cast<std::uint16_t>(sizes[type] + static_cast<std::size_t>(extra)));
    number(h, static_cast<std::uint32_t>(type < 6 ? points : 0));
    h += std::string(20, '\0');
    for (int a = 0; a < 3; ++a) number(h, scale);
    for (int a = 0; a < 3; ++a) number(h, offset);
    h.resize(size);
    if (minor >= 4) std::memcpy(h.data() + 247, &points, 8);
    return h + descriptions_ + records;
  }

 private:
  std::string descriptions_;
  std::uint32_t described_ = 0;
};

}  // namespace atrium::test
