#include <gtest/gtest.h>

#include <limits>

#include "graph/api/error.hpp"
#include "modules/building/ifc_context.hpp"
#include "modules/building/step_file.hpp"
#include "modules/building/step_reader.hpp"

namespace atrium::building::step_test {
namespace {

std::string error_in(const std::string& data) {
  try {
    check_ifc(read_step("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n"));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Step, TextIsAsciiWithEscapes) {
  EXPECT_EQ(step::text("plain").text, "'plain'");
  EXPECT_EQ(step::text("it's a \\").text, "'it''s a \\\\'");
  EXPECT_EQ(step::text("K\u00FCche").text, "'K\\X2\\00FC\\X0\\che'");
  EXPECT_EQ(step::text("\u90E8\u5C4B 1").text, "'\\X2\\90E85C4B\\X0\\ 1'");
  EXPECT_EQ(step::text("\U0001F6AA").text, "'\\X4\\0001F6AA\\X0\\'");
  EXPECT_EQ(step::text("a\nb").text, "'a\\X2\\000A\\X0\\b'");
  EXPECT_EQ(step::text("\xFF\xC3").text, "'\\X2\\FFFDFFFD\\X0\\'") << "no UTF-8";
  for (const std::string text : {"", "it's", "\\X2\\", "K\u00FC''che \\", "\U0001F6AA\u90E8x\n"})
    EXPECT_EQ(text_of(step::text(text).text), text);
}

TEST(Step, NumbersHaveAPoint) {
  EXPECT_EQ(step::real(1).text, "1.");
  EXPECT_EQ(step::real(-0.0).text, "0.");
  EXPECT_EQ(step::real(-1e-12).text, "0.");
  EXPECT_EQ(step::real(5400000.25).text, "5400000.25");
  EXPECT_EQ(step::real(1e-9).text, "0.000000001");
  EXPECT_THROW(step::real(std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(Step, GlobalIdsAreStableAndDiffer) {
  EXPECT_EQ(global_id("wall 3"), global_id("wall 3"));
  EXPECT_NE(global_id("wall 3"), global_id("wall 4"));
  EXPECT_EQ(global_id("a").size(), 22U);
  for (int i = 0; i < 100; ++i) EXPECT_LE(global_id(std::to_string(i))[0], '3');
}

TEST(Step, TheReaderSaysWhatIsWrong) {
  EXPECT_EQ(error_in("#1=IFCDIRECTION((0.,0.,1.));\n"), "no error");
  EXPECT_NE(error_in("#1=IFCDIRECTION((0.,0.,1.),$);\n").find("#1, IFCDIRECTION: 2 fields, not 1"), std::string::npos);
  EXPECT_NE(error_in("#1=IFCPLANE(#2);\n").find("#2 is not there"), std::string::npos);
  EXPECT_NE(
      error_in("#1=IFCDIRECTION(($));\n#1=IFCDIRECTION(($));\n").find("line 6 of the STEP file: #1 is there twice"),
      std::string::npos);
  EXPECT_NE(error_in("#1=IFCMATERIAL('K\u00FCche',$,$);\n").find("not printable ASCII"), std::string::npos);
  EXPECT_NE(error_in("#1=IFCMATERIAL('\\X2\\00F\\X0\\',$,$);\n").find("an escape that is none"), std::string::npos);
  EXPECT_NE(error_in("#1=IFCMATERIAL('open,$,$);\n").find("not printable ASCII"), std::string::npos);
  EXPECT_NE(error_in("#1=IFCBEAM();\n").find("a type that is not written"), std::string::npos);
  EXPECT_NE(error_in("#1=IFCPROPERTYSET('short',$,'n',$,());\n").find("'short' is no GlobalId"), std::string::npos);
  EXPECT_NE(error_in("#1=IFCDIRECTION((1.e));\n").find("is expected"), std::string::npos);
  EXPECT_THROW(read_step("ISO-10303-21;\nHEADER;\n"), Error);
  EXPECT_THROW(read_step(""), Error);
}

}  // namespace
}  // namespace atrium::building::step_test
