#include "modules/io/text_reader.hpp"

#include "graph/api/error.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/row_source.hpp"
#include "modules/io/text_layout.hpp"

namespace atrium::io {

RawGeometry read_text(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  const std::string_view text = without_mark(file->text());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw Error(file->path() + ": text in UTF-16, which is not read", "save it as UTF-8 or ASCII");
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    throw Error(file->path() + ": not a text file (it has zero bytes)");
  Lines lines(text, 1, true, context);
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
  geometry.count = lines.rows() - layout.first_row;
  auto table = std::make_shared<Table>(geometry.count, layout.roles);
  lines.for_rows(layout.first_row, lines.rows(), context, [&](std::size_t, const Row& row) {
    read_numbers(file->path(), row, layout.dialect, layout.roles, table->row(row.index - layout.first_row));
  });
  Table::attach(std::move(table), geometry);
  return geometry;
}

}  // namespace atrium::io
