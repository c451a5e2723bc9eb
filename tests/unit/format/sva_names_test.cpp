#include "sv_format.h"
#include "sv_testing.h"

namespace tetstream::test {
namespace {

TEST(SvaNames, LinesOfTheHeaderAreNeverLongerThan255AndHideKeywords) {
  SvMesh m = randomStream(richSchema(), 5, 1);
  m.schema.fields[2].name = std::string(100, ' ') + "v_pnum_f" + std::string(100, '%');
  const Bytes bytes = writeBytes(createSva, m);
  const std::string text(bytes.begin(), bytes.end());
  size_t lines = 0;
  for (size_t at = 0, end; at < text.size(); at = end + 1, ++lines) {
    end = text.find('\n', at);
    EXPECT_LE(end + 1 - at, 255u);
    const std::string line = text.substr(at, end - at);
    if (line.find("tetstream:") != std::string::npos) {
      EXPECT_EQ(line.find("v_pnum_f"), std::string::npos) << line;
      EXPECT_EQ(line.find("nverts"), std::string::npos) << line;
      EXPECT_EQ(line.find(' ', 2), std::string::npos) << line;
    }
  }
  EXPECT_GT(lines, 20u);
  EXPECT_EQ(readBytes(openSva, bytes).schema.fields[2].name, m.schema.fields[2].name);
}

TEST(SvaNames, WordsThatDoNotFitAreNotUsed) {
  const std::string body = "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nv 0 0 1 1\nc -4 -3 -2 -1\n";
  const auto nameOf = [&](const std::string& words) {
    std::vector<std::string> notes;
    const SvMesh m = readBytes(openSva, bytesOf(words + "# v_pnum_f 4\n" + body), &notes);
    EXPECT_EQ(notes.size(), m.schema.fields[0].name == "p" ? 0u : 1u);
    return m.schema.fields[0].name;
  };
  EXPECT_EQ(nameOf("# tetstream:position:float32\n# tetstream:vertex:float32:1:p\n"), "p");
  EXPECT_EQ(nameOf("# tetstream:vertex:float32:2:p\n"), "scalar");
  EXPECT_EQ(nameOf("# tetstream:vertex:int32:1:p\n"), "scalar");
  EXPECT_EQ(nameOf("# tetstream:vertex:float16:1:p\n"), "scalar");
  EXPECT_EQ(nameOf("# tetstream:vertex:float32:1:\n"), "scalar");
  EXPECT_EQ(nameOf("# tetstream:vertex:float32:1:%4\n"), "scalar");
  EXPECT_EQ(nameOf("# tetstream:edge:float32:1:p\n"), "scalar");
  EXPECT_EQ(nameOf("# tetstream:position:int32\n# tetstream:vertex:float32:1:p\n"), "scalar");
}

TEST(SvaNames, TheDefaultNamesNeedNoWords) {
  Schema schema;
  schema.fields = {{"scalar0", 1, ScalarType::kFloat32},
                   {"scalar1", 1, ScalarType::kFloat32},
                   {"label0", 1, ScalarType::kInt32}};
  schema.cell_data = {{"cell0", 1, ScalarType::kFloat32},
                      {"region0", 1, ScalarType::kInt32},
                      {"region1", 1, ScalarType::kInt32}};
  const Bytes bytes = writeBytes(createSva, randomStream(schema, 5, 1));
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()).find("tetstream"), std::string::npos);
  const SvMesh r = readBytes(openSva, bytes);
  ASSERT_EQ(r.schema.fields.size(), 3u);
  ASSERT_EQ(r.schema.cell_data.size(), 3u);
  EXPECT_EQ(r.schema.fields[1].name, "scalar1");
  EXPECT_EQ(r.schema.cell_data[2].name, "region1");
}

TEST(SvaNames, EveryByteOfANameComesBack) {
  for (int byte = 1; byte < 256; ++byte) {
    Schema schema;
    schema.fields = {{std::string("a") + static_cast<char>(byte) + ':', 1, ScalarType::kFloat64}};
    const SvMesh r = readBytes(openSva, writeBytes(createSva, randomStream(schema, 2, 1)));
    ASSERT_EQ(r.schema.fields.size(), 1u);
    EXPECT_EQ(r.schema.fields[0].name, schema.fields[0].name) << byte;
  }
}

}  // namespace
}  // namespace tetstream::test
