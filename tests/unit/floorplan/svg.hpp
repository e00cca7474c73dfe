#pragma once
#include <gtest/gtest.h>

#include <boost/property_tree/xml_parser.hpp>
#include <functional>
#include <sstream>

#include "modules/floorplan/write_svg.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan {

/// Plans written as SVG files, read back as trees of elements.
class Svg : public testing::Test {
 protected:
  using ptree = boost::property_tree::ptree;
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};
  std::filesystem::path file = host->folder / "floorplan.svg";

  std::string write(const FloorPlan& plan, const WriteSvg::Params& params = {}) {
    WriteSvg::run({input(plan)}, params, context);
    return test::read_text(file);
  }
  std::string error_of(const FloorPlan& plan, const WriteSvg::Params& params) {
    try {
      write(plan, params);
    } catch (const Error& error) {
      EXPECT_FALSE(error.help().empty());
      EXPECT_FALSE(std::filesystem::exists(file));
      return error.what();
    }
    return "no error";
  }

  static ptree parsed(const std::string& text) {
    std::istringstream in(text);
    ptree tree;
    read_xml(in, tree);
    return tree.get_child("svg");
  }

  static void each(const ptree& tree, const std::string& element, const std::function<void(const ptree&)>& visit) {
    for (const auto& [name, child] : tree) {
      if (name == element) visit(child);
      each(child, element, visit);
    }
  }

  static std::vector<std::string> texts(const std::string& svg) {
    std::vector<std::string> result;
    each(parsed(svg), "text", [&](const ptree& text) { result.push_back(text.data()); });
    return result;
  }

  static bool has_text(const std::string& svg, const std::string& text) {
    const auto all = texts(svg);
    return std::find(all.begin(), all.end(), text) != all.end();
  }
};

}  // namespace atrium::floorplan
