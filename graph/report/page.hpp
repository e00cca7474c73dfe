#pragma once
#include "graph/report/attachments.hpp"

namespace atrium::report {

/// Where the page is that reports are written into: beside the program, as it was built or installed.
std::filesystem::path page_template();

/// What the page's program shows, as JSON that may stand in an HTML file whatever the texts in it are.
std::string page_data(const SweepRecord& record, const Attachments& attachments);

/// Writes the report: beside, then renamed. Gives its size. Throws Error, also if the page was not built.
std::size_t write_page(const std::filesystem::path& target, const SweepRecord& record, const Attachments& attachments,
                       const std::filesystem::path& page);

}  // namespace atrium::report
