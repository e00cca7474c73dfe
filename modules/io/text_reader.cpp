#include "modules/io/text_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/row_source.hpp"
#include "modules/io/text_layout.hpp"

namespace atrium::io {
namespace {

/// A block is a piece of the file of about a megabyte.
class TextRows : public RowTable {
 public:
  TextRows(std::shared_ptr<const MappedFile> file, Lines lines, const TextLayout& layout)
      : file_(std::move(file)), lines_(std::move(lines)), layout_(layout) {}

  std::size_t count() const { return lines_.rows() - layout_.first_row; }
  const std::vector<Role>& roles() const override { return layout_.roles; }
  std::size_t blocks() const override { return lines_.pieces().size(); }
  std::size_t rows(std::size_t block) const override {
    const Lines::Piece& piece = lines_.pieces()[block];
    return piece.first_row + piece.rows - std::clamp(layout_.first_row, piece.first_row, piece.first_row + piece.rows);
  }
  std::shared_ptr<Table> read(std::size_t block, const std::vector<Role>& wanted) const override {
    const Lines::Piece& piece = lines_.pieces()[block];
    auto table = std::make_shared<Table>(rows(block), wanted);
    std::size_t next = 0;
    lines_.rows_of(block, layout_.first_row, piece.first_row + piece.rows, [&](const Row& row) {
      read_numbers(file_->path(), row, layout_.dialect, wanted, table->row(next++));
    });
    if (next != rows(block))
      throw Error(fmt::format("{}:{}: {} follow here where {} were counted: the file was changed while it was read",
                              file_->path(), piece.first_line, counted(next, "row"), rows(block)),
                  "read it again when nobody writes to it");
    return table;
  }
  void read_row(std::size_t row, double* to) const override {
    read_numbers(file_->path(), lines_.row(layout_.first_row + row), layout_.dialect, layout_.roles, to);
  }
  std::shared_ptr<Table> read_all(const Context& context) const override {
    auto table = std::make_shared<Table>(count(), layout_.roles);
    lines_.for_rows(layout_.first_row, lines_.rows(), context, [&](std::size_t, const Row& row) {
      read_numbers(file_->path(), row, layout_.dialect, layout_.roles, table->row(row.index - layout_.first_row));
    });
    return table;
  }

 private:
  std::shared_ptr<const MappedFile> file_;
  Lines lines_;
  TextLayout layout_;
};

}  // namespace

RawGeometry read_text(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string_view text = without_mark(file->text());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw Error(file->path() + ": text in UTF-16, which is not read", "save it as UTF-8 or ASCII");
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    throw Error(file->path() + ": not a text file (it has zero bytes)");
  Lines lines(text, 1, true, context, file.get());
  const TextLayout layout = text_layout(file->path(), text, lines, context);
  RawGeometry geometry;
  geometry.path = file->path();
  geometry.metres_per_unit = layout.metres_per_unit;
  if (!layout.scans.empty()) {
    for (const auto& scan : layout.scans) geometry.count += scan.rows;
    geometry.source =
        std::make_shared<const RowSource>(file, std::move(lines), layout.dialect, layout.roles, layout.scans);
    return geometry;
  }
  const auto rows = std::make_shared<const TextRows>(file, std::move(lines), layout);
  geometry.count = rows->count();
  geometry.rows = rows;
  return geometry;
}

}  // namespace atrium::io
