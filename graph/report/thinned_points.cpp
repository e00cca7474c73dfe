#include "graph/report/thinned_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace atrium::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t glb_magic = 0x46546c67, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

struct NoPoints {};  // thrown where the file is another one than this can thin

void need(bool is) {
  if (!is) throw NoPoints{};
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  need(at + 4 <= bytes.size());
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}
void append_number(std::string& bytes, std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&number), 4);
}

std::map<std::uint32_t, std::string_view> chunks_of(std::string_view glb) {
  need(number_at(glb, 0) == glb_magic && number_at(glb, 4) == 2);
  std::map<std::uint32_t, std::string_view> chunks;
  for (std::size_t at = 12; at + 8 <= glb.size();) {
    const std::size_t length = number_at(glb, at);
    need(length <= glb.size() - at - 8);
    chunks.emplace(number_at(glb, at + 4), glb.substr(at + 8, length));
    at += 8 + length;
  }
  return chunks;
}

/// Numbers from 0 to `count`, `kept` of them in their order: one of each stretch, where is drawn by its number.
std::vector<std::size_t> chosen_rows(std::size_t count, std::size_t kept) {
  std::vector<std::size_t> rows;
  rows.reserve(kept);
  for (std::size_t k = 0; k < kept; ++k) {
    const std::size_t from = k * count / kept, to = (k + 1) * count / kept;
    const std::uint64_t drawn = ((k + 1) * 0x9e3779b97f4a7c15ULL) >> 32U;
    rows.push_back(from + drawn % std::max<std::size_t>(1, to - from));
  }
  return rows;
}

class Thinning {
 public:
  Thinning(std::string_view glb, double share) : share_(share) {
    const auto chunks = chunks_of(glb);
    need(chunks.count(json_chunk) != 0 && chunks.count(binary_chunk) != 0);
    json_ = Json::parse(chunks.at(json_chunk));
    binary_ = chunks.at(binary_chunk);
  }

  ThinnedPoints run() {
    find_points();
    Json& views = json_.at("bufferViews");
    Json& accessors = json_.at("accessors");
    std::string bytes;
    for (std::size_t v = 0; v < views.size(); ++v) {
      bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
      const std::size_t begin = bytes.size();
      std::size_t taken = 0;  // of the view, by the accessors so far
      for (auto& accessor : accessors) {
        if (accessor.at("bufferView").get<std::size_t>() != v) continue;
        taken = copy_rows(accessor, views[v], taken, begin, bytes);
      }
      views[v]["byteOffset"] = begin;
      views[v]["byteLength"] = bytes.size() - begin;
    }
    json_.at("buffers").at(0)["byteLength"] = bytes.size();
    result_.glb = file_of(std::move(bytes));
    return std::move(result_);
  }

 private:
  std::size_t kept_of(std::size_t count) const {
    const auto kept = static_cast<std::size_t>(std::floor(share_ * static_cast<double>(count)));
    return std::min(count, std::max<std::size_t>(1, kept));
  }

  /// Counts them; all accessors must be attributes of points, and all attributes of a primitive have its count.
  void find_points() {
    need(json_.at("buffers").size() == 1);
    std::vector<bool> known(json_.at("accessors").size(), false);
    for (const auto& mesh : json_.at("meshes"))
      for (const auto& primitive : mesh.at("primitives")) {
        need(primitive.value("mode", 4) == 0 && !primitive.contains("indices") && !primitive.contains("targets"));
        const auto count_of = [&](const Json& index) {
          return json_.at("accessors").at(index.get<std::size_t>()).at("count").get<std::size_t>();
        };
        const std::size_t count = count_of(primitive.at("attributes").at("POSITION"));
        result_.of += count;
        result_.points += count > 0 ? kept_of(count) : 0;
        for (const auto& attribute : primitive.at("attributes")) {
          need(count_of(attribute) == count && !known.at(attribute.get<std::size_t>()));
          known[attribute.get<std::size_t>()] = true;
        }
      }
    need(std::all_of(known.begin(), known.end(), [](bool is) { return is; }));
  }

  static std::size_t row_size(const Json& accessor, const Json& view) {
    static const std::map<std::string, std::size_t> numbers{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    static const std::map<int, std::size_t> sizes{{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
    const auto row = numbers.find(accessor.at("type").get<std::string>());
    const auto size = sizes.find(accessor.at("componentType").get<int>());
    need(row != numbers.end() && size != sizes.end());
    return view.value("byteStride", row->second * size->second);
  }

  /// Appends the rows of an accessor that stay; gives how much of the view it had.
  std::size_t copy_rows(Json& accessor, const Json& view, std::size_t taken, std::size_t begin, std::string& bytes) {
    const std::size_t row = row_size(accessor, view), count = accessor.at("count").get<std::size_t>();
    const std::size_t offset = accessor.value("byteOffset", std::size_t{0}),
                      from = view.value("byteOffset", std::size_t{0}) + offset;
    need(!accessor.contains("sparse") && offset >= taken && row > 0);
    need(from <= binary_.size() && (count == 0 || count - 1 <= (binary_.size() - from) / row));
    accessor["byteOffset"] = bytes.size() - begin;
    if (count == 0) return offset;
    const auto rows = chosen_rows(count, kept_of(count));
    for (const std::size_t i : rows) {
      const std::string_view part = binary_.substr(from + i * row, row);
      bytes.append(part);
      bytes.append(row - part.size(), '\0');  // the last one may end where its numbers do
    }
    accessor["count"] = rows.size();
    return offset + count * row;
  }

  std::string file_of(std::string bytes) const {
    std::string json = json_.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    std::string glb;
    glb.reserve(28 + json.size() + bytes.size());
    for (const std::size_t n : {std::size_t{glb_magic}, std::size_t{2}, 28 + json.size() + bytes.size(), json.size(),
                                std::size_t{json_chunk}})
      append_number(glb, n);
    glb += json;
    append_number(glb, bytes.size());
    append_number(glb, binary_chunk);
    return glb + bytes;
  }

  double share_;
  Json json_;
  std::string_view binary_;
  ThinnedPoints result_;
};

}  // namespace

std::optional<ThinnedPoints> thinned_points(std::string_view glb, double share) {
  try {
    return Thinning(glb, share).run();
  } catch (const NoPoints&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace atrium::report
