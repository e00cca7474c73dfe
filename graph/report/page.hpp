#pragma once
#include <nlohmann/json_fwd.hpp>

#include "graph/report/attachments.hpp"

namespace atrium::report {

/// Where the pages are that reports ("report.html") and views of a run ("view.html") are written into: beside the
/// program, as it was built or installed.
std::filesystem::path page_template(const std::string& name = "report.html");

/// The page's text. Throws Error, also if it was not built.
std::string read_page(const std::filesystem::path& page);
/// The value as JSON that may stand in an HTML file whatever the texts in it are.
std::string embedded(const nlohmann::ordered_json& json);
/// Writes a page (`page` names it, `text` is read_page of it) with its title, its data and its files in their places:
/// beside, then renamed. Gives its size. Throws Error.
std::size_t write_filled_page(const std::filesystem::path& target, const std::string& title, const std::string& data,
                              const std::vector<Attachment>& files, const std::filesystem::path& page,
                              const std::string& text);

/// What a run is called: the last part of its folder's path.
std::string title_of(const RunRecord& run);

/// What the page's program shows, as JSON that may stand in an HTML file whatever the texts in it are.
std::string page_data(const SweepRecord& record, const Attachments& attachments);

/// Writes the report: beside, then renamed. Gives its size. Throws Error, also if the page was not built.
std::size_t write_page(const std::filesystem::path& target, const SweepRecord& record, const Attachments& attachments,
                       const std::filesystem::path& page);

}  // namespace atrium::report
