// Shared by tests of XDMF files: their text, put together from parts.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "slow_run.h"
#include "vtu_mesh_testing.h"

namespace tetstream::test {

inline std::string xdmfFile(const std::string& domain, const std::string& doctype = "") {
  return doctype + "<Xdmf Version=\"3.0\" xmlns:xi=\"http://www.w3.org/2001/XInclude\"><Domain>" +
         domain + "</Domain></Xdmf>";
}

inline std::string xdmfGrid(const std::string& name, const std::string& content) {
  return "<Grid Name=\"" + name + "\" GridType=\"Uniform\">" + content + "</Grid>";
}

inline std::string xdmfSteps(const std::string& name, const std::string& grids) {
  return "<Grid Name=\"" + name + "\" GridType=\"Collection\" CollectionType=\"Temporal\">" +
         grids + "</Grid>";
}

inline std::string xdmfItem(const std::string& sizes, const std::string& text,
                            const std::string& words = "") {
  return "<DataItem Dimensions=\"" + sizes + "\" " + words + ">" + text + "</DataItem>";
}

// Of integers.
inline std::string xdmfTopology(const std::string& type, const std::string& sizes,
                                const std::string& text) {
  return "<Topology TopologyType=\"" + type + "\">" +
         xdmfItem(sizes, text, "NumberType=\"Int\" Format=\"XML\"") + "</Topology>";
}

inline std::string xdmfGeometry(const std::string& sizes, const std::string& text) {
  return "<Geometry GeometryType=\"XYZ\">" + xdmfItem(sizes, text, "Precision=\"8\"") +
         "</Geometry>";
}

// As dolfinx writes them: the type of the numbers is not told.
inline std::string xdmfValues(const std::string& name, const std::string& sizes,
                              const std::string& text, const std::string& center = "Cell",
                              const std::string& words = "") {
  return "<Attribute Name=\"" + name + "\" AttributeType=\"Scalar\" Center=\"" + center + "\">" +
         xdmfItem(sizes, text, words) + "</Attribute>";
}

const std::string kXdmfFivePoints = xdmfGeometry("5 3", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1");
const std::string kXdmfTwoCells = xdmfTopology("Tetrahedron", "2 4", "0 1 2 3 1 2 3 4");
const std::string kXdmfTwoCellGrid = xdmfGrid("mesh", kXdmfTwoCells + kXdmfFivePoints);
// The points of the first grid that has some.
const std::string kXdmfSamePoints =
    "<xi:include xpointer=\"xpointer(/Xdmf/Domain/Grid/Geometry)\"/>";

// Whether a file that is read is refused wherever it is cut off, and with any bit flipped read or
// refused.
inline void expectXdmfSurvives(const std::string& good) {
  EXPECT_EQ(failureAs("xdmf", good), "");
  for (size_t size = 0; size < good.size(); size += oneIn(5))
    EXPECT_TRUE(failureAs("xdmf", good.substr(0, size)).starts_with("TETSTREAM_BAD_DATA")) << size;
  for (size_t bit = 0; bit < 8 * good.size(); bit += 3 * oneIn(5)) {
    std::string flipped = good;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    const std::string failure = failureAs("xdmf", flipped);
    EXPECT_TRUE(failure.empty() || failure.starts_with("TETSTREAM_BAD_DATA") ||
                failure.starts_with("TETSTREAM_UNSUPPORTED"))
        << bit << ": " << failure;
  }
}

}  // namespace tetstream::test
