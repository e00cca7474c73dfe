#include "graph/pipeline/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <unordered_map>

#include "graph/api/broken_link.hpp"
#include "graph/api/text.hpp"

namespace atrium {
namespace {

constexpr std::size_t deepest = 32;
constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20U;

struct TooDeep {
  Place place;
};

/// Turns marks (bytes) into places (characters).
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') starts_.push_back(i + 1);
  }
  Place place(const YAML::Mark& mark) const {
    if (mark.line < 0 || mark.column < 0) return {};
    const std::size_t line = std::min(static_cast<std::size_t>(mark.line), starts_.size() - 1);
    const std::size_t end = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
    const std::string_view row = text_.substr(starts_[line], end - starts_[line]);
    const std::size_t bytes = std::min(row.size(), static_cast<std::size_t>(mark.column));
    // Marks come in the order of the file, nearly: what was counted in this line is not counted again.
    if (line != line_ || bytes < bytes_) {
      line_ = line;
      bytes_ = characters_ = 0;
    }
    characters_ += count_characters(row.substr(bytes_, bytes - bytes_));
    bytes_ = bytes;
    return {static_cast<int>(line) + 1, static_cast<int>(characters_) + 1};
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
  mutable std::size_t line_ = 0, bytes_ = 0, characters_ = 0;  ///< the last place
};

/// Builds the tree from yaml-cpp's events.
class Builder : public YAML::EventHandler {
 public:
  Builder(const Lines& lines, YamlTree& tree) : lines_(lines), tree_(tree) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2)
      problem(lines_.place(mark), "a second YAML document begins here",
              "one file holds one pipeline: remove the '---'");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    check(mark, {}, anchor);
    YamlNode node;
    node.place = lines_.place(mark);
    add(std::move(node));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    problem(lines_.place(mark), "YAML aliases are not supported",
            "write the value out, or use a variable: \"${name}\"");
    YamlNode node;
    node.place = lines_.place(mark);
    add(std::move(node));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check(mark, tag, anchor);
    YamlNode node;
    node.kind = YamlNode::Kind::scalar;
    node.place = lines_.place(mark);
    node.text = value;
    node.quoted = tag == "!";  // yaml-cpp's mark of a scalar that is not plain
    add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(YamlNode::Kind::sequence, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(YamlNode::Kind::mapping, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    YamlNode node;
    bool has_key = false;  ///< a key has been read, its value not yet
    bool keep = true;      ///< the value that comes belongs to a key that is in order
    std::string key;
    Place key_place;
    std::unordered_map<std::string, Place> keys;
  };

  void problem(Place place, std::string message, std::string help) {
    if (documents_ > 1 && second_reported_) return;  // what else is in a second document does not matter
    second_reported_ = documents_ > 1;
    tree_.problems.push_back({place, std::move(message), std::move(help)});
  }

  void check(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0)
      problem(lines_.place(mark), "YAML anchors are not supported", "remove the '&', or use a variable: \"${name}\"");
    if (!tag.empty() && tag != "?" && tag != "!")
      problem(lines_.place(mark), fmt::format("YAML tags are not supported ('{}')", tag), "remove the tag");
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    check(mark, tag, anchor);
    if (frames_.size() >= deepest) throw TooDeep{lines_.place(mark)};
    Frame frame;
    frame.node.kind = kind;
    frame.node.place = lines_.place(mark);
    frames_.push_back(std::move(frame));
  }

  void close() {
    YamlNode node = std::move(frames_.back().node);
    frames_.pop_back();
    add(std::move(node));
  }

  void add(YamlNode node) {
    if (frames_.empty()) {
      if (documents_ == 1) tree_.root = std::move(node);
      return;
    }
    Frame& frame = frames_.back();
    if (frame.node.is_sequence()) {
      frame.node.items.push_back(std::move(node));
    } else if (!frame.has_key) {
      take_key(frame, node);
    } else {
      if (node.is_null()) node.place = frame.key_place;
      if (frame.keep) frame.node.entries.push_back({std::move(frame.key), frame.key_place, std::move(node)});
      frame.has_key = false;
    }
  }

  void take_key(Frame& frame, const YamlNode& node) {
    frame.has_key = true;
    frame.keep = false;
    frame.key_place = node.place;
    if (!node.is_scalar()) {
      problem(node.place, "a key must be a plain word", "write `name: value`");
    } else if (node.text == "<<") {
      problem(node.place, "YAML merge keys ('<<') are not supported", "write the values out");
    } else if (const auto [first, fresh] = frame.keys.try_emplace(node.text, node.place); !fresh) {
      problem(node.place, fmt::format("duplicate key '{}'", node.text),
              fmt::format("it stands in line {} already: keep one of them", first->second.line));
    } else {
      frame.key = node.text;
      frame.keep = true;
    }
  }

  const Lines& lines_;
  YamlTree& tree_;
  std::vector<Frame> frames_;
  int documents_ = 0;
  bool second_reported_ = false;
};

std::string syntax_help(std::string_view message) {
  if (message.find("illegal map value") != std::string_view::npos)
    return "a text with ': ' in it needs quotes; a list item or mapping may be indented wrongly";
  if (message.find("end of map not found") != std::string_view::npos ||
      message.find("end of sequence not found") != std::string_view::npos)
    return "the indentation before this place is off, or a bracket is open";
  if (message.find("end of map flow") != std::string_view::npos) return "a '{' or a ',' before this place is amiss";
  if (message.find("end of sequence flow") != std::string_view::npos)
    return "a '[' or a ',' before this place is amiss";
  return {};
}

/// What yaml-cpp would misread or accept: bytes that are no text, tabs in the indentation.
bool is_clean_text(std::string_view text, YamlTree& tree) {
  int line = 1;
  for (std::size_t begin = 0; begin <= text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view row = text.substr(begin, end - begin);
    if (const std::size_t bad = first_not_text(row); bad != std::string_view::npos) {
      const int column = static_cast<int>(count_characters(row.substr(0, bad))) + 1;
      tree.problems.push_back({{line, column},
                               fmt::format("the byte 0x{:02x} is not UTF-8 text", static_cast<unsigned char>(row[bad])),
                               "a pipeline file is YAML in UTF-8"});
      return false;
    }
    const std::size_t content = row.find_first_not_of(" \t");
    const std::size_t tab = row.find('\t');
    if (content != std::string_view::npos && tab < content && row[content] != '#')
      tree.problems.push_back({{line, static_cast<int>(tab) + 1}, "a tab in the indentation", "indent with spaces"});
    begin = end + 1;
  }
  return tree.problems.empty();
}

void run_parser(const std::string& text, YamlTree& tree) {
  const Lines lines(text);
  Builder builder(lines, tree);
  const auto broken = [&](Place place, const std::string& message, std::string help) {
    tree.root.reset();
    tree.problems.push_back({place, message, std::move(help)});
  };
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    for (int documents = 0; documents < 2; ++documents)
      if (!parser.HandleNextDocument(builder)) break;
  } catch (const TooDeep& deep) {
    broken(deep.place, fmt::format("nested deeper than {} levels", deepest), "a pipeline file needs five or so");
  } catch (const YAML::Exception& error) {
    broken(lines.place(error.mark), fmt::format("not valid YAML: {}", error.msg), syntax_help(error.msg));
  }
}

}  // namespace

const YamlNode::Entry* YamlNode::find(std::string_view key) const {
  for (const auto& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

YamlTree parse_yaml(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::string unix_text;
  unix_text.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r')
      unix_text += text[i];
    else if (!text.substr(i + 1).starts_with('\n'))
      unix_text += '\n';
  YamlTree tree;
  if (!is_clean_text(unix_text, tree)) return tree;
  run_parser(unix_text, tree);
  if (!tree.root && tree.problems.empty())
    tree.problems.push_back({{}, "the file is empty", "a pipeline file begins with `atrium: 1`"});
  return tree;
}

std::optional<std::string> read_yaml_text(const std::string& file, YamlTree& tree) {
  const auto unreadable = [&](const std::string& why) {
    tree.problems.push_back({{}, "cannot read the file: " + why, {}});
    return std::nullopt;
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    const std::string link = broken_link(file);
    return unreadable(link.empty() ? "no such file" : "it " + link);
  }
  if (std::filesystem::is_directory(status)) return unreadable("it is a folder");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) return unreadable(std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
  std::string text;
  std::string block(std::size_t{1} << 16U, '\0');
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), stream.get())) {
    text.append(block, 0, got);
    if (text.size() > largest_file && !text.starts_with("\x89PNG"))
      return unreadable("it is larger than 16 MiB, which no pipeline is");
  }
  if (std::ferror(stream.get()) != 0) return unreadable(std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
  return text;
}

YamlTree read_yaml(const std::string& file) {
  YamlTree tree;
  const auto text = read_yaml_text(file, tree);
  return text ? parse_yaml(*text) : tree;
}

}  // namespace atrium
