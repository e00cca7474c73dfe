#include "modules/pdf/write_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/helper_process.hpp"
#include "graph/api/text.hpp"
#include "graph/api/write_output.hpp"
#include "modules/floorplan/caption.hpp"
#include "modules/pdf/drawing.hpp"

namespace atrium::pdf {
namespace {

using floorplan::DrawnPlan;
using floorplan::Sheet;

/// A plan for each page.
std::vector<DrawnPlan> pages_of(const DrawnPlan& drawn) {
  if (drawn.storeys.empty()) return {drawn};
  std::vector<DrawnPlan> pages;
  pages.reserve(drawn.storeys.size());
  for (const auto& storey : drawn.storeys) pages.push_back({{storey}, drawn.turn});
  return pages;
}

/// Gives sheets a size that has room for each of them; what is drawn stays in their middles.
void give_one_size(std::vector<Sheet>& sheets) {
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  for (const auto& sheet : sheets) size = size.cwiseMax(sheet.size);
  for (auto& sheet : sheets) {
    const Eigen::Vector2d shift = 0.5 * (size - sheet.size);
    for (auto& place : sheet.places) place += shift;
    sheet.size = size;
    sheet.paper = floorplan::custom_paper(size);
  }
}

/// The sheets of all pages at one scale, the smallest that any of them needs, and where that may be chosen on one
/// paper.
std::vector<Sheet> sheets_of(const std::vector<DrawnPlan>& pages, double origin_z, const WritePlan::Params& params) {
  std::vector<Sheet> sheets;
  const auto arrange = [&](floorplan::Paper paper, int scale) {
    sheets.clear();
    for (const auto& page : pages)
      sheets.push_back(floorplan::arranged(page.storeys, origin_z, paper, scale, params.units));
  };
  arrange(params.paper, params.scale);
  const auto smallest =
      std::max_element(sheets.begin(), sheets.end(), [](const auto& a, const auto& b) { return a.scale < b.scale; });
  const int scale = smallest->scale;
  arrange(params.paper, scale);
  if (params.paper != floorplan::Paper::automatic) return sheets;
  const auto largest = std::max_element(sheets.begin(), sheets.end(),
                                        [](const auto& a, const auto& b) { return a.size.prod() < b.size.prod(); });
  if (std::all_of(sheets.begin(), sheets.end(),
                  [](const auto& s) { return floorplan::paper_named(s.paper).has_value(); }))
    arrange(*floorplan::paper_named(largest->paper), scale);
  else
    give_one_size(sheets);
  return sheets;
}

std::vector<std::string> texts_of(const DrawnPlan& drawn, const std::string& title) {
  std::vector<std::string> texts{title};
  for (const auto& storey : drawn.storeys)
    for (const auto& room : storey.rooms) texts.push_back(room.name);
  return texts;
}

void warn_of_fonts(const std::vector<std::string>& lacking, const Context& context) {
  if (lacking.empty()) return;
  context.warn(
      fmt::format("no installed font has all characters of '{}'{}: boxes stand for them (Debian's "
                  "fonts-noto-core and fonts-noto-cjk have most scripts)",
                  lacking.front(), lacking.size() > 1 ? " and " + counted(lacking.size() - 1, "more text") : ""));
}

/// In a process of its own: the libraries that draw end a program where memory or threads lack.
DrawingReply drawn_by_helper(const DrawingRequest& request, const Context& context) {
  static const char anchor = 0;
  const std::string name = "atrium-pdf-draw";
  const std::filesystem::path file = folder_of_library(&anchor) / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw Error(fmt::format("the program {} that draws is lacking (looked for {})", name, file.string()),
                "build and install the plugin and its program together");
  HelperProcess helper;
  helper.name = name;
  helper.file = file;
  constexpr double least_seconds = 120, seconds_a_page = 60;  // a page takes a tenth of a second
  helper.seconds = least_seconds + seconds_a_page * static_cast<double>(request.pages.size());
  helper.at_time_limit = "the fonts of this machine may be on a disk that does not answer: fc-list shows whether";
  const HelperReply bytes = run_helper_process(helper, to_bytes(request), context);
  DrawingReply reply;
  try {
    reply = reply_from(bytes.bytes);
  } catch (const std::exception& error) {
    throw Error(fmt::format("{} gave no reply that can be read: {}", name, error.what()),
                "build and install the plugin and its program together");
  }
  if (!reply.problem.empty()) throw Error(reply.problem, reply.help);
  return reply;
}

}  // namespace

void WritePlan::run(const In& in, const Params& params, Context& context) {
  const FloorPlan& plan = *in.plan;
  const DrawnPlan drawn = floorplan::drawn_plan(plan, params.storey, params.axes);
  const std::string accuracy = floorplan::accuracy_text(in.accuracy ? &*in.accuracy : nullptr);
  if (drawn.storeys.empty()) context.warn("the plan is empty: " + params.path.path + " shows nothing");
  const std::vector<DrawnPlan> pages = pages_of(drawn);
  const std::vector<Sheet> sheets = sheets_of(pages, floorplan::origin_height(plan), params);
  DrawingRequest request{params.title, texts_of(drawn, params.title), {}};
  request.pages.reserve(pages.size());
  for (std::size_t i = 0; i < pages.size(); ++i)
    request.pages.push_back(
        {floorplan::svg_sheet(
             plan, pages[i], sheets[i],
             {params.title, accuracy, pages.size() > 1 ? fmt::format("; page {} of {}", i + 1, pages.size()) : "",
              params.dimensions}),
         sheets[i].size.x(), sheets[i].size.y()});
  const DrawingReply reply = drawn_by_helper(request, context);
  warn_of_fonts(reply.lacking, context);
  write_output(context, params.path.path, reply.file);
}

}  // namespace atrium::pdf
