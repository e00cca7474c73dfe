#include "modules/pdf/pdf_pages.hpp"

#include <cairo-pdf.h>
#include <librsvg/rsvg.h>
#include <pango/pangocairo.h>

#include <string_view>

#include "graph/api/error.hpp"

namespace atrium::pdf {
namespace {

constexpr double points_per_mm = 72 / 25.4;

struct Release {
  void operator()(cairo_t* drawing) const { cairo_destroy(drawing); }
  void operator()(RsvgHandle* svg) const { g_object_unref(svg); }
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(PangoContext* context) const { g_object_unref(context); }
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
  void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

cairo_status_t append(void* text, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("the page cannot be drawn: ") + cairo_status_to_string(status));
}

}  // namespace

struct PdfPages::Surface {
  std::string text;
  cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append, &text, 1, 1);

  Surface() = default;
  ~Surface() { cairo_surface_destroy(surface); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
};

PdfPages::PdfPages(const std::string& title) : surface_(std::make_unique<Surface>()) {
  cairo_surface_t* surface = surface_->surface;
  check(cairo_surface_status(surface));
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "Atrium");
  // The time is always the same, as in IFC files.
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
}

PdfPages::~PdfPages() = default;

void PdfPages::add(const std::string& svg, const Eigen::Vector2d& size) {
  GError* problem = nullptr;
  const auto fail = [&] {
    const Owned<GError> error(problem);
    throw Error(std::string("the sheet cannot be drawn: ") + (error ? error->message : "no reason is given"));
  };
  const Owned<RsvgHandle> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &problem));
  if (!handle) fail();
  const Eigen::Vector2d points = points_per_mm * size;
  cairo_pdf_surface_set_size(surface_->surface, points.x(), points.y());
  const Owned<cairo_t> drawing(cairo_create(surface_->surface));
  const RsvgRectangle page{0, 0, points.x(), points.y()};
  if (rsvg_handle_render_document(handle.get(), drawing.get(), &page, &problem) == FALSE) fail();
  cairo_show_page(drawing.get());
  check(cairo_status(drawing.get()));
}

std::string PdfPages::finish() && {
  cairo_surface_finish(surface_->surface);
  check(cairo_surface_status(surface_->surface));
  // Cairo 1.16 leaves out the "D:" that dates begin with (ISO 32000-1, 7.9.4). As many blanks go, since the file counts
  // its bytes.
  const std::string_view without = "   /CreationDate (1970", with = " /CreationDate (D:1970";
  if (const auto at = surface_->text.find(without); at != std::string::npos)
    surface_->text.replace(at, without.size(), with);
  return std::move(surface_->text);
}

std::vector<std::string> texts_without_font(const std::vector<std::string>& texts) {
  const Owned<PangoContext> context(pango_font_map_create_context(pango_cairo_font_map_get_default()));
  const Owned<PangoLayout> layout(pango_layout_new(context.get()));
  const Owned<PangoFontDescription> font(
      pango_font_description_from_string("Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif"));
  pango_layout_set_font_description(layout.get(), font.get());
  const auto lacks = [&](const std::string& text) {
    pango_layout_set_text(layout.get(), text.c_str(), static_cast<int>(text.size()));
    return pango_layout_get_unknown_glyphs_count(layout.get()) > 0;
  };
  if (lacks("N 0")) throw Error("no font is installed", "for instance: apt-get install fonts-dejavu-core");
  std::vector<std::string> result;
  for (const auto& text : texts)
    if (lacks(text)) result.push_back(text);
  return result;
}

}  // namespace atrium::pdf
