// format/xdmf: the attributes of grids as arrays of a mesh. Depends on xdmf_arrays.h,
// xdmf_functions.h.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "xdmf_arrays.h"
#include "xdmf_functions.h"

namespace tetstream {

// What cannot be read is noted in the mesh.
class XdmfFields {
 public:
  XdmfFields(XdmfArrays& arrays, MeshPieces& mesh, MeshPiece& piece, const std::string& temp_dir)
      : arrays_(arrays), mesh_(mesh), piece_(piece), temp_dir_(temp_dir) {}

  // Of a grid that has the piece's points and cells, which are there.
  void add(const std::vector<XdmfAttribute>& attributes);
  // Of a grid with other cells, `cells` of them; `spread` makes arrays of all of the piece out of
  // its. Where the file does not tell what they hold, whole numbers become integers.
  using Spread = std::function<MeshArray(MeshArray)>;
  void add(const std::vector<XdmfAttribute>& attributes, uint64_t cells, const Spread& spread);

  // The values, as many to each of `rows`, at least one, as there are components; throws if they
  // are not. None if it is no list of values or has too many components.
  std::optional<MeshArray> valuesOf(const XdmfAttribute& attribute, uint64_t rows,
                                    bool may_be_whole);

 private:
  void add(const XdmfAttribute& attribute, uint64_t rows, const Spread& spread,
           std::vector<MeshArray>& list);
  void addFunction(const XdmfAttribute& attribute);
  void addFunction(const XdmfAttribute& attribute, uint64_t numbers_each, bool is_of_points);
  XdmfFunction functionOf(const XdmfAttribute& attribute, int components);
  std::optional<int> componentsOf(const XdmfAttribute& attribute, uint64_t count, uint64_t rows);
  bool isNew(const XdmfAttribute& attribute, const std::vector<MeshArray>& list);
  // The values of text of which the file does not tell what they are, if all are whole.
  std::optional<MeshArray> wholeOf(XdmfItem item, const std::string& name, int components);

  XdmfArrays& arrays_;
  MeshPieces& mesh_;
  MeshPiece& piece_;
  const std::string& temp_dir_;
};

}  // namespace tetstream
