#include "modules/floorplan/dxf_frame.hpp"

#include <algorithm>
#include <array>

namespace atrium::floorplan {
namespace {

// The tables and the objects that every file has. Layers and entities come after them.
enum Fixed : DxfHandle {
  table_of_blocks = 0x1,
  table_of_layers,
  table_of_styles,
  table_of_line_types = 0x5,
  table_of_views,
  table_of_axes,
  table_of_viewports,
  table_of_applications,
  table_of_dimension_styles,
  root = 0xC,
  groups,
  plot_styles,
  plot_style,
  layer_0,
  style,
  application,
  by_block,
  by_layer,
  continuous,
  layouts,
  dimension_style,
  viewport,
  paper_space,
  paper_layout,
  paper_begin,
  paper_end,
  model_layout,
  model_begin,
  model_space = dxf_model_space,
  model_end,
  own_dimension_style,
  first_layer,
};

constexpr int plot_by_colour = 1;
const Eigen::Vector2d zero = Eigen::Vector2d::Zero(), one = Eigen::Vector2d::Ones(), a3(420, 297);

using Integers = std::vector<std::pair<int, int>>;
using Reals = std::vector<std::pair<int, double>>;

// How the format names units.
int insertion_unit(Units units) { return units == Units::feet ? 1 : units == Units::millimetres ? 4 : 6; }
int unit_style(Units units) { return units == Units::feet ? 4 : 2; }  // architectural: 11'-4 1/2"; decimal
int decimals(Units units) { return units == Units::feet ? 1 : units == Units::millimetres ? 0 : 2; }  // half inches

// What dimensions look like: the numbers of a style's groups and the header's variables for the same.
struct DimensionSize {
  int code;
  const char* variable;
  double mm;  // of paper
};
constexpr std::array<DimensionSize, 7> dimension_sizes{{{41, "$DIMASZ", dxf_digits},
                                                        {42, "$DIMEXO", dxf_extension_gap},
                                                        {43, "$DIMDLI", 8},
                                                        {44, "$DIMEXE", dxf_extension_over},
                                                        {140, "$DIMTXT", dxf_digits},
                                                        {142, "$DIMTSZ", dxf_tick},
                                                        {147, "$DIMGAP", dxf_text_gap}}};
struct DimensionChoice {
  int code;
  const char* variable;
  int value;
};
// Text along the line and above it, a line between the stops always, text that may be moved without a leader, a point
// for a comma, zeros kept.
std::array<DimensionChoice, 9> dimension_choices(Units units) {
  return {{{73, "$DIMTIH", 0},
           {74, "$DIMTOH", 0},
           {77, "$DIMTAD", 1},
           {78, "$DIMZIN", units == Units::feet ? 1 : 0},
           {172, "$DIMTOFL", 1},
           {271, "$DIMDEC", decimals(units)},
           {277, "$DIMLUNIT", unit_style(units)},
           {278, "$DIMDSEP", '.'},
           {279, "$DIMTMOVE", 2}}};
}

// The format's way to say that there is nothing: the lower corner above the upper one.
const Eigen::Vector2d nothing = Eigen::Vector2d::Constant(1e20);
Eigen::Vector2d low(const Bounds2& b) { return b.empty() ? nothing : b.low; }
Eigen::Vector2d high(const Bounds2& b) { return b.empty() ? Eigen::Vector2d(-nothing) : b.high; }
double low_z(const Bounds2& b) { return b.empty() ? nothing.x() : 0; }
double high_z(const Bounds2& b) { return b.empty() ? -nothing.x() : 0; }

void write_header(DxfGroups& out, const DxfFrame& frame) {
  const auto variable = [&](const char* name, int code, auto value) {
    out.text(9, name);
    if constexpr (std::is_convertible_v<decltype(value), const char*>)
      out.text(code, value);
    else
      out.integer(code, value);
  };
  const auto place = [&](const char* name, const Eigen::Vector2d& p, double z) {
    out.text(9, name);
    out.point(10, p, z);
  };
  out.begin_section("HEADER");
  variable("$ACADVER", 1, "AC1015");
  variable("$DWGCODEPAGE", 3, "ANSI_1252");
  place("$INSBASE", zero, 0);
  place("$EXTMIN", low(frame.extents), low_z(frame.extents));
  place("$EXTMAX", high(frame.extents), high_z(frame.extents));
  variable("$CLAYER", 8, "0");
  variable("$CELTYPE", 6, "ByLayer");
  variable("$TEXTSTYLE", 7, "Standard");
  variable("$DIMSTYLE", 2, dxf_dimension_style);
  for (const auto& [code, name, mm] : dimension_sizes) {
    out.text(9, name);
    out.real(40, mm * frame.mm);
  }
  for (const auto& [code, name, value] : dimension_choices(frame.units)) variable(name, 70, value);
  variable("$LUNITS", 70, unit_style(frame.units));
  variable("$LUPREC", 70, frame.units == Units::metres ? 3 : decimals(frame.units));
  variable("$AUNITS", 70, 0);
  variable("$INSUNITS", 70, insertion_unit(frame.units));
  variable("$MEASUREMENT", 70, frame.units == Units::feet ? 0 : 1);
  variable("$PSTYLEMODE", 290, plot_by_colour);
  out.text(9, "$HANDSEED");
  out.handle(5, frame.next_handle);
  out.end_section();
}

void write_classes(DxfGroups& out) {
  out.begin_section("CLASSES");
  for (const auto& [name, type] :
       {std::pair("ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"), std::pair("ACDBPLACEHOLDER", "AcDbPlaceHolder"),
        std::pair("LAYOUT", "AcDbLayout")}) {
    out.text(0, "CLASS");
    out.text(1, name);
    out.text(2, type);
    out.text(3, "ObjectDBX Classes");
    for (const int code : {90, 280, 281}) out.integer(code, 0);
  }
  out.end_section();
}

void begin_table(DxfGroups& out, const char* name, DxfHandle handle, std::size_t rows) {
  out.text(0, "TABLE");
  out.text(2, name);
  out.handle(5, handle);
  out.handle(330, 0);
  out.subclass("AcDbSymbolTable");
  out.integer(70, static_cast<std::int64_t>(rows));
}

void begin_row(DxfGroups& out, const char* kind, DxfHandle handle, DxfHandle table, const char* type,
               const std::string& name, bool flags = true) {
  out.record(kind, handle, table);
  out.subclass("AcDbSymbolTableRecord");
  out.subclass(type);
  out.text(2, name);
  if (flags) out.integer(70, 0);
}

void end_table(DxfGroups& out) { out.text(0, "ENDTAB"); }

void write_viewports(DxfGroups& out, const Bounds2& view) {
  begin_table(out, "VPORT", table_of_viewports, 1);
  begin_row(out, "VPORT", viewport, table_of_viewports, "AcDbViewportTableRecord", "*Active");
  // Corners on the screen, centre, snap and grid, direction, target.
  out.point(10, zero);
  out.point(11, one);
  out.point(12, view.empty() ? zero : Eigen::Vector2d(0.5 * (view.low + view.high)));
  out.point(13, zero);
  out.point(14, one);
  out.point(15, one);
  out.point(16, zero, 1);
  out.point(17, zero, 0);
  out.real(40, std::max(1.5 * view.size().maxCoeff(), 1.0));  // height
  out.real(41, 1.6);                                          // width over height
  out.real(42, 50);                                           // focal length, mm
  for (const int code : {43, 44, 50, 51}) out.real(code, 0);
  for (const auto& [code, value] : Integers{{71, 0}, {72, 100}, {73, 1}, {74, 3}, {75, 0}, {76, 0}, {77, 0}, {78, 0}})
    out.integer(code, value);
  end_table(out);
}

void write_line_types(DxfGroups& out) {
  begin_table(out, "LTYPE", table_of_line_types, 3);
  for (const auto& [handle, name] :
       {std::pair(by_block, "ByBlock"), std::pair(by_layer, "ByLayer"), std::pair(continuous, "Continuous")}) {
    begin_row(out, "LTYPE", handle, table_of_line_types, "AcDbLinetypeTableRecord", name);
    out.text(3, "");
    out.integer(72, 65);
    out.integer(73, 0);
    out.real(40, 0);
  }
  end_table(out);
}

void write_layers(DxfGroups& out, const std::vector<DxfLayer>& layers) {
  const auto row = [&](DxfHandle handle, const DxfLayer& layer) {
    begin_row(out, "LAYER", handle, table_of_layers, "AcDbLayerTableRecord", layer.name);
    out.integer(62, layer.colour);
    out.text(6, "Continuous");
    out.integer(370, layer.line_weight);
    out.handle(390, plot_style);
  };
  begin_table(out, "LAYER", table_of_layers, layers.size() + 1);
  row(layer_0, {"0"});
  for (std::size_t i = 0; i < layers.size(); ++i) row(first_layer + static_cast<DxfHandle>(i), layers[i]);
  end_table(out);
}

void write_styles(DxfGroups& out) {
  begin_table(out, "STYLE", table_of_styles, 1);
  begin_row(out, "STYLE", style, table_of_styles, "AcDbTextStyleTableRecord", "Standard");
  out.real(40, 0);
  out.real(41, 1);
  out.real(50, 0);
  out.integer(71, 0);
  out.real(42, 2.5);
  out.text(3, "txt");
  out.text(4, "");
  end_table(out);
}

void write_dimension_styles(DxfGroups& out, const DxfFrame& frame) {
  begin_table(out, "DIMSTYLE", table_of_dimension_styles, 2);
  out.subclass("AcDbDimStyleTable");
  begin_row(out, "DIMSTYLE", dimension_style, table_of_dimension_styles, "AcDbDimStyleTableRecord", "Standard");
  // Arrows, gaps and texts.
  for (const auto& [code, mm] : Reals{{41, 2}, {42, 1}, {43, 3.75}, {44, 1}, {140, 2.5}, {147, 0.5}})
    out.real(code, mm * frame.mm);
  out.handle(340, style);
  begin_row(out, "DIMSTYLE", own_dimension_style, table_of_dimension_styles, "AcDbDimStyleTableRecord",
            dxf_dimension_style);
  for (const auto& [code, name, mm] : dimension_sizes) out.real(code, mm * frame.mm);
  for (const auto& [code, name, value] : dimension_choices(frame.units)) out.integer(code, value);
  out.handle(340, style);
  end_table(out);
}

void write_tables(DxfGroups& out, const DxfFrame& frame) {
  out.begin_section("TABLES");
  write_viewports(out, frame.view);
  write_line_types(out);
  write_layers(out, frame.layers);
  write_styles(out);
  begin_table(out, "VIEW", table_of_views, 0);
  end_table(out);
  begin_table(out, "UCS", table_of_axes, 0);
  end_table(out);
  begin_table(out, "APPID", table_of_applications, 1);
  begin_row(out, "APPID", application, table_of_applications, "AcDbRegAppTableRecord", "ACAD");
  end_table(out);
  write_dimension_styles(out, frame);
  begin_table(out, "BLOCK_RECORD", table_of_blocks, 2 + frame.blocks.size());
  for (const auto& [handle, name, layout] :
       {std::tuple(model_space, "*Model_Space", model_layout), std::tuple(paper_space, "*Paper_Space", paper_layout)}) {
    begin_row(out, "BLOCK_RECORD", handle, table_of_blocks, "AcDbBlockTableRecord", name, false);
    out.handle(340, layout);
  }
  for (const auto& block : frame.blocks) {
    begin_row(out, "BLOCK_RECORD", block.record, table_of_blocks, "AcDbBlockTableRecord", block.name, false);
    out.handle(340, 0);
  }
  end_table(out);
  out.end_section();
}

void write_block(DxfGroups& out, const std::string& name, DxfHandle block, DxfHandle begin, DxfHandle end,
                 const DxfGroups* entities = nullptr) {
  const auto entity = [&](const char* kind, DxfHandle handle, const char* type) {
    out.record(kind, handle, block);
    out.subclass("AcDbEntity");
    if (block == paper_space) out.integer(67, 1);
    out.text(8, "0");
    out.subclass(type);
  };
  entity("BLOCK", begin, "AcDbBlockBegin");
  out.text(2, name);
  out.integer(70, entities != nullptr ? 1 : 0);  // 1: it has no name of its own
  out.point(10, zero, 0);
  out.text(3, name);
  out.text(1, "");
  if (entities != nullptr) out.append(*entities);
  entity("ENDBLK", end, "AcDbBlockEnd");
}

void write_dictionary(DxfGroups& out, DxfHandle handle, DxfHandle owner,
                      const std::vector<std::pair<const char*, DxfHandle>>& entries, const char* kind = "DICTIONARY") {
  out.record(kind, handle, owner);
  out.subclass("AcDbDictionary");
  out.integer(281, 1);
  for (const auto& [name, entry] : entries) {
    out.text(3, name);
    out.handle(350, entry);
  }
}

// How a space is plotted: on A3, nothing chosen yet. The model's has its own mark.
void write_plot_settings(DxfGroups& out, bool model) {
  out.subclass("AcDbPlotSettings");
  out.text(1, "");
  out.text(2, "none_device");
  out.text(4, "");
  out.text(6, "");
  for (const int code : {40, 41, 42, 43}) out.real(code, 0);
  out.real(44, a3.x());
  out.real(45, a3.y());
  for (const int code : {46, 47, 48, 49, 140, 141}) out.real(code, 0);
  out.real(142, 1);
  out.real(143, 1);
  for (const auto& [code, value] : Integers{{70, model ? 1024 : 0}, {72, 1}, {73, 0}, {74, 5}})
    out.integer(code, value);
  out.text(7, "");
  out.integer(75, 16);
  out.real(147, 1);
  out.real(148, 0);
  out.real(149, 0);
}

void write_layout(DxfGroups& out, bool model, const Bounds2& extents) {
  out.record("LAYOUT", model ? model_layout : paper_layout, layouts);
  write_plot_settings(out, model);
  out.subclass("AcDbLayout");
  out.text(1, model ? "Model" : "Layout1");
  out.integer(70, 1);
  out.integer(71, model ? 0 : 1);
  // Limits, insertion, extents, height, axes.
  out.point(10, zero);
  out.point(11, a3);
  out.point(12, zero, 0);
  out.point(14, low(extents), low_z(extents));
  out.point(15, high(extents), high_z(extents));
  out.real(146, 0);
  out.point(13, zero, 0);
  out.point(16, Eigen::Vector2d::UnitX(), 0);
  out.point(17, Eigen::Vector2d::UnitY(), 0);
  out.integer(76, 0);
  out.handle(330, model ? model_space : paper_space);
}

}  // namespace

DxfHandle first_entity_handle(std::size_t layers) { return first_layer + static_cast<DxfHandle>(layers); }

DxfGroups dxf_beginning(const DxfFrame& frame) {
  DxfGroups out;
  if (!frame.comment.empty()) out.text(999, dxf_text(frame.comment));
  write_header(out, frame);
  write_classes(out);
  write_tables(out, frame);
  out.begin_section("BLOCKS");
  write_block(out, "*Model_Space", model_space, model_begin, model_end);
  write_block(out, "*Paper_Space", paper_space, paper_begin, paper_end);
  for (const auto& block : frame.blocks)
    write_block(out, block.name, block.record, block.begin, block.end, &block.entities);
  out.end_section();
  return out;
}

DxfGroups dxf_end(const DxfFrame& frame) {
  DxfGroups out;
  out.begin_section("OBJECTS");
  write_dictionary(out, root, 0,
                   {{"ACAD_GROUP", groups}, {"ACAD_LAYOUT", layouts}, {"ACAD_PLOTSTYLENAME", plot_styles}});
  write_dictionary(out, groups, root, {});
  write_dictionary(out, layouts, root, {{"Layout1", paper_layout}, {"Model", model_layout}});
  write_dictionary(out, plot_styles, root, {{"Normal", plot_style}}, "ACDBDICTIONARYWDFLT");
  out.subclass("AcDbDictionaryWithDefault");
  out.handle(340, plot_style);
  out.record("ACDBPLACEHOLDER", plot_style, plot_styles);
  write_layout(out, true, frame.extents);
  write_layout(out, false, {});
  out.end_section();
  out.text(0, "EOF");
  return out;
}

}  // namespace atrium::floorplan
