// format/xdmf: what an XDMF file says, before any value of it is read. Depends on xml_feed.h.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "xml_feed.h"

namespace tetstream {

// Values: text of the file itself, or the name of a dataset in another one, or of a raw file.
struct XdmfItem {
  std::string format = "XML", kind = "Float";  // "HDF", "Binary"; "Int", "UInt", "Char", "UChar"
  bool has_kind = false;                       // the file tells it
  uint64_t precision = 4;                      // bytes
  std::string order = "Native", compression = "Raw";  // of a raw file: "Little", "Big"
  uint64_t seek = 0;                                  // its bytes before the values
  std::vector<uint64_t> sizes;
  uint64_t begin = 0, end = 0;  // of the text, in bytes of the file
  // Of a hyperslab: its begin, stride and count along each direction, and what it is cut from.
  bool is_slab = false;
  std::vector<XdmfItem> parts;
  // Of one that stands for another one: where that is, as XPath; "XML": its text tells.
  std::string reference;

  uint64_t count() const;
  // Whether the file does not tell what the values are: text without NumberType, where each number
  // shows what it is.
  bool isUntyped() const;
};

struct XdmfAttribute {
  std::string name, center = "Node", type;  // "Vector"
  // Of a function of a finite element space, which has more than values at the nodes.
  bool is_function = false;
  std::string family, cell;        // "CG", "tetrahedron"
  std::optional<uint64_t> degree;  // where it is a number
  std::vector<XdmfItem> items;
};

struct XdmfTopology {
  std::string type;  // "Tetrahedron"
  std::vector<XdmfItem> items;
};

struct XdmfGeometry {
  std::string type = "XYZ";
  std::vector<XdmfItem> items;
};

struct XdmfGrid {
  std::string name;
  enum Kind { kUniform, kTemporal, kSpatial } kind = kUniform;
  int parent = -1;             // in the list of all
  std::optional<double> time;  // NaN: what is told is no number
  std::optional<XdmfTopology> topology;
  std::optional<XdmfGeometry> geometry;
  std::vector<XdmfAttribute> attributes;
  std::vector<std::string> includes;  // xpointers to what the grid takes from others
  std::string other_file;             // the first that it takes a part from
  bool has_sets = false;              // of nodes, faces or cells
  std::vector<XdmfItem> times;        // of the grids in it, in a list
  bool has_even_times = false;        // the list is the first one, the step and their number
};

struct XdmfFile {
  std::vector<XdmfGrid> grids;  // in the order of the file, each after the one that it is in
  std::map<std::string, XdmfItem> named;  // of the domain itself, by name the first one
  std::map<std::string, std::string> entities;
};

// References are as the file has them: see xdmf_references.h.
XdmfFile readXdmfTree(ByteSource& bytes);

bool sameWord(const std::string& a, const char* b);  // but for the case

}  // namespace tetstream
