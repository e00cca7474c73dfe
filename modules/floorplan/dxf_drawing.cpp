#include "modules/floorplan/dxf_drawing.hpp"

#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "graph/api/error.hpp"

namespace atrium::floorplan {
namespace {

constexpr int polyline_closed = 1, centred = 1, middle = 2, metres = 6, metric = 1;

DL_Attributes on(const std::string& layer) { return {layer, 256, -1, "BYLAYER", 1.0}; }

void write_head(DL_Dxf& dxf, DL_WriterA& out) {
  dxf.writeHeader(out);
  out.dxfString(9, "$INSUNITS");
  out.dxfInt(70, metres);
  out.dxfString(9, "$MEASUREMENT");
  out.dxfInt(70, metric);
  out.sectionEnd();
}

// The view in which the file opens; dxflib's own shows the neighbourhood of zero.
void write_view(DL_WriterA& out, const Eigen::Vector2d& centre, double height) {
  out.table("VPORT", 1, 8);
  out.dxfString(0, "VPORT");
  out.handle();
  out.dxfString(100, "AcDbSymbolTableRecord");
  out.dxfString(100, "AcDbViewportTableRecord");
  out.dxfString(2, "*Active");
  out.dxfInt(70, 0);
  // Corners on the screen, centre, snap and grid, direction, target.
  const std::vector<std::pair<int, double>> numbers{
      {10, 0},      {20, 0},   {11, 1},  {21, 1}, {12, centre.x()}, {22, centre.y()}, {13, 0}, {23, 0}, {14, 1},
      {24, 1},      {15, 1},   {25, 1},  {16, 0}, {26, 0},          {36, 1},          {17, 0}, {27, 0}, {37, 0},
      {40, height}, {41, 1.6}, {42, 50}, {43, 0}, {44, 0},          {50, 0},          {51, 0}};
  for (const auto& [code, value] : numbers) out.dxfReal(code, value);
  for (const auto& [code, value] :
       std::vector<std::pair<int, int>>{{71, 0}, {72, 100}, {73, 1}, {74, 3}, {75, 0}, {76, 0}, {77, 0}, {78, 0}})
    out.dxfInt(code, value);
  out.tableEnd();
}

void write_tables(DL_Dxf& dxf, DL_WriterA& out, const std::vector<DxfLayer>& layers, const Eigen::Vector2d& centre,
                  double height) {
  out.sectionTables();
  write_view(out, centre, height);
  out.tableLinetypes(3);
  for (const auto* name : {"BYBLOCK", "BYLAYER", "CONTINUOUS"})
    dxf.writeLinetype(out, DL_LinetypeData(name, name, 0, 0, 0.0));
  out.tableEnd();
  out.tableLayers(static_cast<int>(layers.size()) + 1);
  dxf.writeLayer(out, DL_LayerData("0", 0), DL_Attributes("", 7, 25, "CONTINUOUS", 1.0));
  for (const auto& layer : layers)
    dxf.writeLayer(out, DL_LayerData(layer.name, 0),
                   DL_Attributes("", layer.colour, layer.line_weight, "CONTINUOUS", 1.0));
  out.tableEnd();
  out.tableStyle(1);
  dxf.writeStyle(out, DL_StyleData("Standard", 0, 0.0, 1.0, 0.0, 0, 2.5, "txt", ""));
  out.tableEnd();
  dxf.writeView(out);
  dxf.writeUcs(out);
  out.tableAppid(1);
  dxf.writeAppid(out, "ACAD");
  out.tableEnd();
  dxf.writeDimStyle(out, 0.2, 0.1, 0.1, 0.05, 0.2);
  dxf.writeBlockRecord(out);
  out.tableEnd();
  out.sectionEnd();
}

void write_blocks(DL_Dxf& dxf, DL_WriterA& out) {
  out.sectionBlocks();
  for (const auto* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    dxf.writeBlock(out, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
    dxf.writeEndBlock(out, name);
  }
  out.sectionEnd();
}

}  // namespace

std::string dxf_text(std::string_view utf8) {
  std::string result;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    if (lead < 0x80) {
      if (lead >= 0x20 && lead != 0x7F) result += utf8[i];
      continue;
    }
    const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 0;
    std::uint32_t code = lead & (0x3FU >> more);
    int read = 0;
    for (; read < more && i + 1 < utf8.size() && (utf8[i + 1] & 0xC0) == 0x80; ++read, ++i)
      code = code << 6U | (static_cast<unsigned char>(utf8[i + 1]) & 0x3FU);
    result += more == 0 || read < more || code > 0xFFFF ? "?" : fmt::format("\\U+{:04X}", code);
  }
  return result;
}

struct DxfDrawing::Writer {
  DL_Dxf dxf;
  std::unique_ptr<DL_WriterA> out;
  Eigen::Vector2d origin;
  std::filesystem::path path;
};

DxfDrawing::DxfDrawing(AtomicFile& file, const Eigen::Vector2d& origin, const std::vector<DxfLayer>& layers,
                       const Bounds2& view)
    : writer_(std::make_unique<Writer>()) {
  writer_->origin = origin;
  writer_->path = file.path();
  writer_->out.reset(writer_->dxf.out(file.path().c_str(), DL_VERSION_2000));
  if (!writer_->out) throw Error("cannot write " + file.path().string(), "is the folder there, and writable?");
  write_head(writer_->dxf, *writer_->out);
  write_tables(writer_->dxf, *writer_->out, layers,
               origin + (view.empty() ? Eigen::Vector2d::Zero().eval() : (0.5 * (view.low + view.high)).eval()),
               std::max(1.5 * view.size().maxCoeff(), 1.0));
  write_blocks(writer_->dxf, *writer_->out);
  writer_->out->sectionEntities();
}

DxfDrawing::~DxfDrawing() = default;

void DxfDrawing::line(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d from = writer_->origin + a, to = writer_->origin + b;
  writer_->dxf.writeLine(*writer_->out, DL_LineData(from.x(), from.y(), 0, to.x(), to.y(), 0), on(layer));
}

void DxfDrawing::arc(const std::string& layer, const Eigen::Vector2d& middle, const Eigen::Vector2d& a,
                     const Eigen::Vector2d& b) {
  const auto degrees = [&](const Eigen::Vector2d& p) {
    const double angle = std::atan2(p.y() - middle.y(), p.x() - middle.x()) * 180 / std::numbers::pi;
    return angle < 0 ? angle + 360 : angle;
  };
  const Eigen::Vector2d at = writer_->origin + middle;
  writer_->dxf.writeArc(*writer_->out, DL_ArcData(at.x(), at.y(), 0, (a - middle).norm(), degrees(a), degrees(b)),
                        on(layer));
}

void DxfDrawing::closed_polyline(const std::string& layer, const PlanRing& ring) {
  DL_WriterA& out = *writer_->out;
  writer_->dxf.writePolyline(out, DL_PolylineData(static_cast<int>(ring.size()), 0, 0, polyline_closed), on(layer));
  for (const auto& corner : ring) {
    const Eigen::Vector2d p = writer_->origin + corner;
    writer_->dxf.writeVertex(out, DL_VertexData(p.x(), p.y(), 0));
  }
  writer_->dxf.writePolylineEnd(out);
}

void DxfDrawing::text(const std::string& layer, const Eigen::Vector2d& at, double height, const std::string& text,
                      double angle) {
  const Eigen::Vector2d p = writer_->origin + at;
  writer_->dxf.writeText(
      *writer_->out,
      DL_TextData(p.x(), p.y(), 0, p.x(), p.y(), 0, height, 1, 0, centred, middle, dxf_text(text), "Standard", angle),
      on(layer));
}

void DxfDrawing::finish() {
  writer_->out->sectionEnd();
  writer_->dxf.writeObjects(*writer_->out);
  writer_->dxf.writeObjectsEnd(*writer_->out);
  writer_->out->dxfEOF();
  writer_->out->close();
  // dxflib does not tell whether it could write: the end of the file does.
  std::ifstream in(writer_->path, std::ios::binary | std::ios::ate);
  std::string tail(std::min<std::streamoff>(in.tellg(), 8), ' ');
  in.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  if (!in || tail.find("EOF") == std::string::npos)
    throw Error("cannot write all of " + writer_->path.string(), "is the disk full?");
}

}  // namespace atrium::floorplan
