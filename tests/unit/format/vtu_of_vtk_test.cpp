// Files as VTK 9.1 itself writes them, letter for letter: field data, an array of strings and facts
// about arrays among the values.
#include <gtest/gtest.h>

#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

// clang-format off
const char* const kAscii =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n"
    "  <UnstructuredGrid>\n"
    "    <FieldData>\n"
    "      <DataArray type=\"Float32\" Name=\"TIME\" NumberOfTuples=\"1\" format=\"ascii\" "
    "RangeMin=\"1\" RangeMax=\"1\">\n"
    "        1\n"
    "      </DataArray>\n"
    "    </FieldData>\n"
    "    <Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n"
    "      <PointData Scalars=\"p q\">\n"
    "        <DataArray type=\"Float32\" Name=\"p q\" format=\"ascii\" RangeMin=\"0\" "
    "RangeMax=\"0.4000000059604645\">\n"
    "          0 0.10000000149011612 0.20000000298023224 0.30000001192092896 "
    "0.4000000059604645\n"
    "        </DataArray>\n"
    "        <DataArray type=\"Float32\" Name=\"vel\" NumberOfComponents=\"3\" "
    "ComponentName0=\"X\" format=\"ascii\" RangeMin=\"2.23606797749979\" "
    "RangeMax=\"2.271563339369689\">\n"
    "          0 1 2 0.10000000149011612 1 2\n"
    "          0.20000000298023224 1 2 0.30000001192092896 1 2\n"
    "          0.4000000059604645 1 2\n"
    "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
    "            <Value index=\"0\">\n"
    "              2.2360679775\n"
    "            </Value>\n"
    "            <Value index=\"1\">\n"
    "              2.2715633394\n"
    "            </Value>\n"
    "          </InformationKey>\n"
    "        </DataArray>\n"
    "        <Array type=\"String\" Name=\"str\" format=\"ascii\">\n"
    "          97 48 0 97 49 0 97 50 0 97 51 0 97 52 0\n"
    "        </Array>\n"
    "      </PointData>\n"
    "      <CellData>\n"
    "        <DataArray type=\"UInt8\" Name=\"c\" format=\"ascii\" RangeMin=\"1\" RangeMax=\"2\">\n"
    "          1 2\n"
    "        </DataArray>\n"
    "      </CellData>\n"
    "      <Points>\n"
    "        <DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" "
    "format=\"ascii\" RangeMin=\"0\" RangeMax=\"1.7320508075688772\">\n"
    "          0 0 0 1 0 0\n"
    "          0 1 0 0 0 1\n"
    "          1 1 1\n"
    "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
    "            <Value index=\"0\">\n"
    "              0\n"
    "            </Value>\n"
    "            <Value index=\"1\">\n"
    "              1.7320508076\n"
    "            </Value>\n"
    "          </InformationKey>\n"
    "        </DataArray>\n"
    "      </Points>\n"
    "      <Cells>\n"
    "        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\" RangeMin=\"0\" "
    "RangeMax=\"4\">\n"
    "          0 1 2 3 1 2\n"
    "          3 4\n"
    "        </DataArray>\n"
    "        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\" RangeMin=\"4\" "
    "RangeMax=\"8\">\n"
    "          4 8\n"
    "        </DataArray>\n"
    "        <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\" RangeMin=\"10\" "
    "RangeMax=\"10\">\n"
    "          10 10\n"
    "        </DataArray>\n"
    "      </Cells>\n"
    "    </Piece>\n"
    "  </UnstructuredGrid>\n"
    "</VTKFile>\n";

const char* const kBinary =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n"
    "  <UnstructuredGrid>\n"
    "    <FieldData>\n"
    "      <DataArray type=\"Float32\" Name=\"TIME\" NumberOfTuples=\"1\" format=\"binary\" "
    "RangeMin=\"1\" RangeMax=\"1\">\n"
    "        AQAAAACAAAAEAAAADAAAAA==eJxjYGiwBwABQwDA\n"
    "      </DataArray>\n"
    "    </FieldData>\n"
    "    <Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n"
    "      <PointData Scalars=\"p q\">\n"
    "        <DataArray type=\"Float32\" Name=\"p q\" format=\"binary\" RangeMin=\"0\" "
    "RangeMax=\"0.4000000059604645\">\n"
    "          AQAAAACAAAAUAAAAGwAAAA==eJxjYGBgOHvmjO3ZMz52s2bOtAOy7QBT2Alz\n"
    "        </DataArray>\n"
    "        <DataArray type=\"Float32\" Name=\"vel\" NumberOfComponents=\"3\" "
    "ComponentName0=\"X\" format=\"binary\" RangeMin=\"2.23606797749979\" "
    "RangeMax=\"2.271563339369689\">\n"
    "          AQAAAACAAAA8AAAAIgAAAA==eJxjYACBBnsg4XD2zBlbBNvHDsaeNXOmHZIaOBsAnz4Obg==\n"
    "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
    "            <Value index=\"0\">\n"
    "              2.2360679775\n"
    "            </Value>\n"
    "            <Value index=\"1\">\n"
    "              2.2715633394\n"
    "            </Value>\n"
    "          </InformationKey>\n"
    "        </DataArray>\n"
    "        <Array type=\"String\" Name=\"str\" format=\"binary\">\n"
    "          AQAAAACAAAAPAAAAFwAAAA==eJxLNGBINGRINGJINGZINGEAABjOAuA=\n"
    "        </Array>\n"
    "      </PointData>\n"
    "      <CellData>\n"
    "        <DataArray type=\"UInt8\" Name=\"c\" format=\"binary\" RangeMin=\"1\" "
    "RangeMax=\"2\">\n"
    "          AQAAAACAAAACAAAACgAAAA==eJxjZAIAAAYABA==\n"
    "        </DataArray>\n"
    "      </CellData>\n"
    "      <Points>\n"
    "        <DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" "
    "format=\"binary\" RangeMin=\"0\" RangeMax=\"1.7320508075688772\">\n"
    "          AQAAAACAAAA8AAAAEgAAAA==eJxjYEAGDfYMBPkIDABPVgR7\n"
    "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
    "            <Value index=\"0\">\n"
    "              0\n"
    "            </Value>\n"
    "            <Value index=\"1\">\n"
    "              1.7320508076\n"
    "            </Value>\n"
    "          </InformationKey>\n"
    "        </DataArray>\n"
    "      </Points>\n"
    "      <Cells>\n"
    "        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"binary\" RangeMin=\"0\" "
    "RangeMax=\"4\">\n"
    "          AQAAAACAAABAAAAAFgAAAA==eJxjYIAARijNBKWZCYizQGkAAfAAEQ==\n"
    "        </DataArray>\n"
    "        <DataArray type=\"Int64\" Name=\"offsets\" format=\"binary\" RangeMin=\"4\" "
    "RangeMax=\"8\">\n"
    "          AQAAAACAAAAQAAAADgAAAA==eJxjYYAADigNAACQAA0=\n"
    "        </DataArray>\n"
    "        <DataArray type=\"UInt8\" Name=\"types\" format=\"binary\" RangeMin=\"10\" "
    "RangeMax=\"10\">\n"
    "          AQAAAACAAAACAAAACgAAAA==eJzj4gIAACAAFQ==\n"
    "        </DataArray>\n"
    "      </Cells>\n"
    "    </Piece>\n"
    "  </UnstructuredGrid>\n"
    "</VTKFile>\n";

const char* const kAppended =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n"
    "  <UnstructuredGrid>\n"
    "    <FieldData>\n"
    "      <DataArray type=\"Float32\" Name=\"TIME\" NumberOfTuples=\"1\" format=\"appended\" "
    "RangeMin=\"1\"                    RangeMax=\"1\"                    offset=\"0\"          "
    "         >\n"
    "      </DataArray>\n"
    "    </FieldData>\n"
    "    <Piece NumberOfPoints=\"5\"                    NumberOfCells=\"2\"                  "
    " >\n"
    "      <PointData Scalars=\"p q\">\n"
    "        <DataArray type=\"Float32\" Name=\"p q\" format=\"appended\" RangeMin=\"0\"         "
    "           RangeMax=\"0.40000000596\"        offset=\"40\"                  >\n"
    "        </DataArray>\n"
    "        <DataArray type=\"Float32\" Name=\"vel\" NumberOfComponents=\"3\" "
    "ComponentName0=\"X\" format=\"appended\" RangeMin=\"2.2360679775\"         "
    "RangeMax=\"2.2715633394\"         offset=\"100\"                 >\n"
    "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
    "            <Value index=\"0\">\n"
    "              2.2360679775\n"
    "            </Value>\n"
    "            <Value index=\"1\">\n"
    "              2.2715633394\n"
    "            </Value>\n"
    "          </InformationKey>\n"
    "        </DataArray>\n"
    "        <Array type=\"String\" Name=\"str\" format=\"appended\" offset=\"172\"              "
    "   />\n"
    "      </PointData>\n"
    "      <CellData>\n"
    "        <DataArray type=\"UInt8\" Name=\"c\" format=\"appended\" RangeMin=\"1\"             "
    "       RangeMax=\"2\"                    offset=\"228\"                 >\n"
    "        </DataArray>\n"
    "      </CellData>\n"
    "      <Points>\n"
    "        <DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" "
    "format=\"appended\" RangeMin=\"0\"                    RangeMax=\"1.7320508076\"         "
    "offset=\"268\"                 >\n"
    "          <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
    "            <Value index=\"0\">\n"
    "              0\n"
    "            </Value>\n"
    "            <Value index=\"1\">\n"
    "              1.7320508076\n"
    "            </Value>\n"
    "          </InformationKey>\n"
    "        </DataArray>\n"
    "      </Points>\n"
    "      <Cells>\n"
    "        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" RangeMin=\"\"   "
    "                  RangeMax=\"\"                     offset=\"316\"                 />\n"
    "        <DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" RangeMin=\"\"        "
    "             RangeMax=\"\"                     offset=\"372\"                 />\n"
    "        <DataArray type=\"UInt8\" Name=\"types\" format=\"appended\" RangeMin=\"\"          "
    "           RangeMax=\"\"                     offset=\"416\"                 >\n"
    "        </DataArray>\n"
    "      </Cells>\n"
    "    </Piece>\n"
    "  </UnstructuredGrid>\n"
    "  <AppendedData encoding=\"base64\">\n"
    "   _AQAAAACAAAAEAAAADAAAAA==eJxjYGiwBwABQwDAAQAAAACAAAAUAAAAGwAAAA==eJxjYGBgOHvmjO3Z"
    "Mz52s2bOtAOy7QBT2AlzAQAAAACAAAA8AAAAIgAAAA==eJxjYACBBnsg4XD2zBlbBNvHDsaeNXOmHZIaOBsA"
    "nz4Obg==AQAAAACAAAAPAAAAFwAAAA==eJxLNGBINGRINGJINGZINGEAABjOAuA=AQAAAACAAAACAAAACgAA"
    "AA==eJxjZAIAAAYABA==AQAAAACAAAA8AAAAEgAAAA==eJxjYEAGDfYMBPkIDABPVgR7AQAAAACAAABAAAAA"
    "FgAAAA==eJxjYIAARijNBKWZCYizQGkAAfAAEQ==AQAAAACAAAAQAAAADgAAAA==eJxjYYAADigNAACQAA0="
    "AQAAAACAAAACAAAACgAAAA==eJzj4gIAACAAFQ==\n"
    "  </AppendedData>\n"
    "</VTKFile>\n";
// clang-format on

TEST(VtuOfVtk, ReadsAsciiBinaryAndAppended) {
  for (const char* file : {kAscii, kBinary, kAppended}) {
    const VtuMesh mesh = readVtu(file);
    EXPECT_EQ(valuesAs<float>(mesh.positions),
              (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    ASSERT_EQ(mesh.schema.fields.size(), 2u);
    EXPECT_EQ(mesh.schema.fields[0].name, "p q");
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{0, 0.1f, 0.2f, 0.3f, 0.4f}));
    EXPECT_EQ(mesh.schema.fields[1].name, "vel");
    EXPECT_EQ(valuesAs<float>(mesh.fields[1]),
              (std::vector<float>{0, 1, 2, 0.1f, 1, 2, 0.2f, 1, 2, 0.3f, 1, 2, 0.4f, 1, 2}));
    ASSERT_EQ(mesh.schema.cell_data.size(), 1u);
    EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{1, 2}));
    EXPECT_EQ(mesh.notes.size(), 1u);  // the strings
    EXPECT_EQ(mesh.schema.time, 1);    // as VisIt calls it
  }
}

// Also as ParaView calls it; of one row.
TEST(VtuOfVtk, TakesTheTimeByItsName) {
  for (const char* file : {kAscii, kBinary, kAppended}) {
    std::string text = file;
    const size_t name = text.find("\"TIME\"");
    text.replace(name, 6, "\"Time\"");
    EXPECT_FALSE(readVtu(text).schema.time);
    EXPECT_EQ(readVtu(text).notes.size(), 2u);  // the field data and the strings
    text.replace(name, 6, "\"TimeValue\"");
    EXPECT_EQ(readVtu(text).schema.time, 1);
    EXPECT_EQ(readVtu(text).notes.size(), 1u);
    const size_t rows = text.find("NumberOfTuples=\"1\"");
    text.insert(rows, "NumberOfComponents=\"3\" ");
    EXPECT_FALSE(readVtu(text).schema.time);
    EXPECT_EQ(readVtu(text).notes.size(), 2u);
    text.replace(rows, 22, "NumberOfComponents=\"1\"");
    EXPECT_EQ(readVtu(text).schema.time, 1);
    text.replace(text.find("NumberOfTuples=\"1\""), 18, "NumberOfTuples=\"2\"");
    EXPECT_FALSE(readVtu(text).schema.time);
    EXPECT_EQ(readVtu(text).notes.size(), 2u);
  }
}

}  // namespace
}  // namespace tetstream
