#include "modules/types/crs_name.hpp"

#include <gtest/gtest.h>

#include "graph/api/error.hpp"
#include "tests/support/warnings.hpp"

namespace atrium::crs_name_test {
namespace {

TEST(CrsName, IsTheShortOneOfAllWaysToWriteIt) {
  EXPECT_EQ(crs_name(""), "");
  EXPECT_EQ(crs_name("epsg:25832"), "EPSG:25832");
  EXPECT_EQ(crs_name("urn:ogc:def:crs:EPSG::25832"), "EPSG:25832");
  EXPECT_EQ(crs_name("urn:ogc:def:crs:EPSG:9.9.1:25832"), "EPSG:25832");
  EXPECT_EQ(crs_name("https://www.opengis.net/def/crs/EPSG/0/25832"), "EPSG:25832");
  EXPECT_EQ(crs_name("http://www.opengis.net/def/crs/epsg/0/25832"), "EPSG:25832");
  EXPECT_EQ(crs_name("PROJCS[\"ETRS89 / UTM zone "
                     "32N\",GEOGCS[\"ETRS89\",AUTHORITY[\"EPSG\",\"4258\"]],AUTHORITY[\"EPSG\",\"25832\"]]"),
            "EPSG:25832");
  EXPECT_EQ(crs_name("PROJCRS[\"local grid\",BASEGEOGCRS[\"x\"]]"), "local grid");
  EXPECT_EQ(epsg_code("EPSG:25832"), 25832);
  EXPECT_EQ(epsg_code("local grid"), 0);
}

TEST(CrsName, WhatIsNoneIsAnErrorThatSaysHowItIsWritten) {
  for (const auto* bad : {"UTM 32", "EPSG:", "EPSG:12a", "25832", "ESRI:102100", "urn:ogc:def:crs:OGC::CRS84",
                          "https://www.opengis.net/def/crs/EPSG/0/"}) {
    try {
      crs_name(bad);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(bad), std::string::npos);
      EXPECT_NE(error.help().find("EPSG:25832"), std::string::npos);
    }
  }
}

TEST(CrsName, DegreesAreNoMetres) {
  try {
    crs_name("EPSG:4326");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "EPSG:4326 counts in degrees, the model in metres");
  }
}

TEST(CrsName, WhatIsGivenStandsBeforeWhatTheScanSays) {
  test::Warnings warnings;
  const Context& context = warnings.context();
  Cloud scan;
  EXPECT_EQ(crs_of("", nullptr, context), "");
  EXPECT_EQ(crs_of("", &scan, context), "");
  scan.crs = "EPSG:32633";
  EXPECT_EQ(crs_of("", &scan, context), "EPSG:32633");
  EXPECT_EQ(crs_of("EPSG:25832", &scan, context), "EPSG:25832");
  EXPECT_THROW(crs_of("somewhere", &scan, context), Error);
  EXPECT_TRUE(warnings.texts().empty());
  scan.unit = 0.3048;
  EXPECT_EQ(crs_of("", &scan, context), "");
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_NE(warnings.texts()[0].find("units of 0.3048 m"), std::string::npos);
  scan.unit = 1;
  scan.crs = "UTM 32";
  EXPECT_EQ(crs_of("", &scan, context), "") << "what a file says must not end the run";
  ASSERT_EQ(warnings.texts().size(), 2U);
  EXPECT_NE(warnings.texts()[1].find("'UTM 32' names no coordinate reference system"), std::string::npos);
}

}  // namespace
}  // namespace atrium::crs_name_test
