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

constexpr const char* projected =
    R"(PROJCS["UTM 32",GEOGCS["ETRS89",AUTHORITY["EPSG","4258"]],UNIT["metre",1,AUTHORITY["EPSG","9001"]]%)";

/// `projected` with this authority of its own.
std::string utm(const std::string& authority) {
  std::string text = projected;
  return text.replace(text.find('%'), 1, authority + "]");
}

TEST(CrsName, ACodeIsThatOfTheProjectedSystemItself) {
  const std::string heights = R"(VERT_CS["DHHN2016",AUTHORITY["EPSG","7837"]])";
  EXPECT_EQ(crs_name("COMPD_CS[\"both\"," + utm(R"(,AUTHORITY["EPSG","25832"])") + "," + heights + "]"), "EPSG:25832");
  EXPECT_EQ(crs_name("COMPD_CS[\"both\"," + utm("") + "," + heights + "]"), "both") << "7837 is that of the heights";
  EXPECT_EQ(crs_name(utm("")), "UTM 32") << "9001 is that of the metre";
  EXPECT_EQ(crs_name(utm(R"(,AUTHORITY["ESRI","102100"])")), "UTM 32");
  EXPECT_EQ(crs_name(utm(", AUTHORITY [\"EPSG\", \"25832\"]")), "EPSG:25832") << "with blanks";
  EXPECT_EQ(crs_name(utm(",EXTENSION[\"a ] b\"],AUTHORITY[\"EPSG\",\"25832\"]")), "EPSG:25832")
      << "a bracket in a text";
  const std::string base =
      R"(BASEGEOGCRS["ETRS89",ID["EPSG",4258]],CS[Cartesian,2],LENGTHUNIT["metre",1,ID["EPSG",9001]])";
  EXPECT_EQ(crs_name("PROJCRS[\"UTM 32\"," + base + ",ID[\"EPSG\",25832]]"), "EPSG:25832");
  EXPECT_EQ(crs_name("PROJCRS[\"UTM 32\"," + base + "]"), "UTM 32");
  EXPECT_EQ(crs_name("COMPOUNDCRS[\"both\",PROJCRS[\"UTM 32\"," + base +
                     ",ID[\"EPSG\",25832]],VERTCRS[\"h\",ID[\"EPSG\",7837]]]"),
            "EPSG:25832");
}

TEST(CrsName, WellKnownTextInDegreesIsAnError) {
  const auto error_of = [](const std::string& text) {
    try {
      return crs_name(text);
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(error_of(R"(GEOGCS["WGS 84",UNIT["degree",0.0174],AUTHORITY["EPSG","4326"]])"),
            "EPSG:4326 counts in degrees, the model in metres");
  EXPECT_EQ(error_of(R"(GEOGCRS["WGS 84",CS[ellipsoidal,2],ID["EPSG",4326]])"),
            "EPSG:4326 counts in degrees, the model in metres");
  EXPECT_EQ(error_of(R"(GEOGCS["NAD27",UNIT["degree",0.0174]])"), "'NAD27' counts in degrees, the model in metres");
}

TEST(CrsName, OfWhatIsTurnedUprightThereIsNone) {
  test::Warnings warnings;
  Transform turn;
  EXPECT_EQ(crs_of("EPSG:25832", nullptr, turn, "building", warnings.context()), "EPSG:25832");
  EXPECT_TRUE(warnings.texts().empty());
  turn.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EXPECT_EQ(crs_of("EPSG:25832", nullptr, turn, "building", warnings.context()), "");
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_TRUE(warnings.texts()[0].starts_with("the building is turned upright, out of EPSG:25832"));
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
  EXPECT_TRUE(warnings.texts().empty()) << "the reader has said so";
  scan.unit = 1;
  scan.crs = "UTM 32";
  EXPECT_EQ(crs_of("", &scan, context), "") << "what a file says must not end the run";
  ASSERT_EQ(warnings.texts().size(), 1U);
  EXPECT_NE(warnings.texts()[0].find("'UTM 32' names no coordinate reference system"), std::string::npos);
}

}  // namespace
}  // namespace atrium::crs_name_test
