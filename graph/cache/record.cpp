#include "graph/cache/record.hpp"

#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_fields.hpp"
#include "graph/api/json_text.hpp"
#include "graph/cache/places.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
constexpr int version = 3;

constexpr std::tuple output_fields{json_field("port", &OutputRecord::port), json_field("type", &OutputRecord::type),
                                   json_field("bytes", &OutputRecord::bytes),
                                   optional_json_field("hash", &OutputRecord::hash),
                                   optional_json_field("facts", &OutputRecord::facts)};
constexpr std::tuple artefact_fields{json_field("path", &Artefact::path), json_field("bytes", &Artefact::bytes),
                                     optional_json_field("hash", &Artefact::hash)};
constexpr std::tuple record_fields{
    json_field("key", &CacheRecord::key),         json_field("fields", &CacheRecord::fields),
    json_field("node", &CacheRecord::node),       json_field("made", &CacheRecord::made),
    json_field("outputs", &CacheRecord::outputs), json_field("warnings", &CacheRecord::warnings),
    json_field("files", &CacheRecord::files),     json_field("wall_seconds", &CacheRecord::wall),
    json_field("cpu_seconds", &CacheRecord::cpu), json_field("peak_memory", &CacheRecord::peak_memory)};

}  // namespace

void to_json(Json& json, const OutputRecord& output) { json = fields_json(output, output_fields); }
void from_json(const Json& json, OutputRecord& output) { read_fields(json, output, output_fields); }
void to_json(Json& json, const Artefact& file) { json = fields_json(file, artefact_fields); }
void from_json(const Json& json, Artefact& file) { read_fields(json, file, artefact_fields); }

// As a list, which is shorter: most of a record are these.
void to_json(Json& json, const NodeKey::Field& field) { json = Json::array({field.name, field.value}); }
void from_json(const Json& json, NodeKey::Field& field) {
  json.at(0).get_to(field.name);
  json.at(1).get_to(field.value);
}

std::string record_text(const CacheRecord& record) {
  Json json{{"version", version}};
  json.update(fields_json(record, record_fields));
  json["growth"] = record.growth ? Json(*record.growth) : Json();
  const std::string text = json_text(json) + "\n";
  return hash_of_text(text) + "\n" + text;
}

std::optional<CacheRecord> read_record(const std::string& text) {
  const std::size_t line = text.find('\n');
  if (line == std::string::npos) return std::nullopt;
  const std::string_view rest = std::string_view(text).substr(line + 1);
  if (hash_of_text(rest) != std::string_view(text).substr(0, line)) return std::nullopt;
  try {
    const Json json = read_json(rest);
    if (json.at("version") != version) return std::nullopt;
    CacheRecord record;
    read_fields(json, record, record_fields);
    if (const Json& growth = json.at("growth"); !growth.is_null()) record.growth = growth.get<std::uint64_t>();
    // Hashes become names of files.
    const auto is_hashed = [](const auto& part) { return is_content_hash(part.hash); };
    if (NodeKey{record.fields}.hex() != record.key ||
        !std::all_of(record.outputs.begin(), record.outputs.end(), is_hashed) ||
        !std::all_of(record.files.begin(), record.files.end(), is_hashed))
      return std::nullopt;
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace atrium
