// Reads Gmsh's files, formats 1, 2 and 4, text and binary, in one go: sections between $NAME and
// $EndNAME, of format 1 $ENDNAME. Nodes and elements have tags at will; physical groups are the
// regions of cells and the labels of faces.
#include <cmath>
#include <cstring>
#include <optional>

#include "gmsh_format.h"
#include "label_names.h"
#include "msh_mesh.h"
#include "status.h"
#include "text_number.h"

namespace tetstream {

namespace {

constexpr int kAnyDimension = -1;  // of a name

class MshReader {
 public:
  MshReader(std::unique_ptr<ByteSource> bytes, const ReadOptions& options)
      : file_(std::move(bytes), 0, options.threads), mesh_(file_, options) {}

  std::unique_ptr<IndexedSource> read() {
    is_version_1_ = file_.peekWord() == "$NOD";
    if (!is_version_1_) readFormat();
    for (;;) {
      const std::string name(file_.word());
      if (name.empty()) break;
      if (name[0] != '$') file_.failBad(quoted(name) + " where a section should begin");
      is_version_1_ ? readSection1(name.substr(1)) : readSection(name.substr(1));
    }
    if (!mesh_.intake) file_.failBad("there is no section $Nodes");
    nameGroups();
    return mesh_.intake->finish();
  }

 private:
  // Version, 0 for text or 1 for binary, the size of a float; if binary, an integer 1.
  void readFormat() {
    while (file_.peekWord() == "$Comments") {
      file_.word();
      readComments();
    }
    file_.expect("$MeshFormat");
    const double version = file_.real("the version of the format");
    const int64_t binary = file_.integer("the kind of the file", 0, 1);
    const int64_t size = file_.integer("the size of numbers");
    if (size != 4 && size != 8)
      file_.failBad(
          textOf("the size of numbers is %lld, not 4 or 8", static_cast<long long>(size)));
    mesh_.is_4_0 = version == 4;
    mesh_.version_4 = mesh_.is_4_0 || std::fabs(version - 4.1) < 1e-9;
    if (!mesh_.version_4 && !(version >= 2 && version < 3))
      file_.failHere(Status::kUnsupported,
                     textOf("version %g of Gmsh's format; 2 to 2.2, 4 and 4.1 are read, and 1, "
                            "which has no such section",
                            version));
    mesh_.size_bytes = static_cast<size_t>(size);
    if (binary) {
      file_.line();
      readByteOrder();
    }
    file_.expect("$EndMeshFormat");
  }

  void readByteOrder() {
    unsigned char one[4];
    file_.bytes(one, sizeof one, "the integer 1");
    uint32_t value;
    std::memcpy(&value, one, sizeof value);
    if (value != 1 && value != 0x01000000) file_.failBad("no integer 1 after the format");
    mesh_.numbers.setBinary(value != 1);
  }

  void readSection(const std::string& name) {
    const bool v4 = mesh_.version_4;
    const std::string end = "$End" + name;
    if (name == "PhysicalNames") {
      readNames();
    } else if (name == "Comments") {
      return readComments();
    } else if (v4 && (name == "Entities" || name == "PartitionedEntities")) {
      endLine();
      readEntities4(mesh_, name[0] == 'P');
    } else if ((name == "Nodes" && mesh_.intake) || (name == "Elements" && is_again_)) {
      return passAgain(name);
    } else if (name == "ParametricNodes" && !v4) {
      endLine();
      readParametricNodes2(mesh_);
    } else if (name == "Nodes") {
      endLine();
      v4 ? readNodes4(mesh_) : readNodes2(mesh_);
    } else if (name == "Elements") {
      needNodes();
      endLine();
      v4 ? readElements4(mesh_) : readElements2(mesh_);
    } else if (name == "NodeData" || name == "ElementData") {
      data_.read(mesh_, name[0] == 'E');
    } else {
      return leaveOut(name, end);
    }
    file_.expect(end.c_str());
  }

  // Sections have no format before them, and other names.
  void readSection1(const std::string& name) {
    const std::string end = "$END" + name;
    if (name == "NOD") {
      readNodes2(mesh_);
    } else if (name == "ELM") {
      needNodes();
      readElements1(mesh_);
    } else {
      return leaveOut(name, end);
    }
    file_.expect(end.c_str());
  }

  void needNodes() {
    if (!mesh_.intake) file_.failBad("elements before the nodes that they use");
  }

  void leaveOut(const std::string& name, const std::string& end) {
    if (options().note) options().note(file_.name() + ": the section $" + name + " is left out");
    file_.skipPast(end);
  }

  // Gmsh writes the mesh again with each view that it adds to a file: the nodes, and then elements.
  void passAgain(const std::string& name) {
    endLine();
    const bool of_nodes = name == "Nodes";
    const uint64_t before = of_nodes ? mesh_.node_rows : mesh_.element_rows;
    const uint64_t again = mesh_.version_4
                               ? readRowCount4(mesh_)
                               : static_cast<uint64_t>(file_.integer("a number of rows"));
    if (again != before)
      file_.failBad(textOf("a second section of %s, of %llu: the first has %llu",
                           of_nodes ? "nodes" : "elements", static_cast<unsigned long long>(again),
                           static_cast<unsigned long long>(before)));
    if (options().note)
      options().note(file_.name() + ": the section $" + name + " is there again: it is left out");
    is_again_ = true;
    file_.skipPast("$End" + name);
  }

  // Of binary sections, the numbers begin on the next line.
  void endLine() {
    if (mesh_.version_4 && mesh_.numbers.binary()) file_.line();
  }

  // One a line: dimension, number, name; in format 2.0 without the dimension. What follows the name
  // is for other programs.
  void readNames() {
    const int64_t count = file_.integer("the number of names", 0, INT64_MAX);
    file_.checkClaim(static_cast<uint64_t>(count), 6, "names");
    for (int64_t i = 0; i < count; ++i) {
      const int64_t first = file_.integer("the dimension or number of a group");
      const bool has_dimension = file_.peekWord().substr(0, 1) != "\"";
      const int64_t tag = has_dimension ? file_.integer("the number of a group") : first;
      if (has_dimension && (first < 0 || first > 3))
        file_.failBad(
            textOf("the dimension of a group is %lld, not 0 to 3", static_cast<long long>(first)));
      const int dimension = has_dimension ? static_cast<int>(first) : kAnyDimension;
      mesh_.names.emplace(std::pair(dimension, tag), file_.text("the name of a group"));
      file_.line();
    }
  }

  void readComments() {
    file_.line();
    for (;;) {
      const std::string_view text = file_.line();
      if (text == "$EndComments") return;
      readMshHint(text, &mesh_.hints);
      if (file_.atEnd()) file_.failBad("the file ends within comments");
    }
  }

  void noteFurtherGroups() {
    std::vector<LabelName> groups;
    for (const auto& group : mesh_.further_groups) {
      const auto [dimension, tag] = group;
      const auto name = mesh_.names.find(group);
      if (dimension > 1)
        groups.push_back({dimension == 2 ? "" : kMshPhysical, tag,
                          name != mesh_.names.end() ? name->second : ""});
    }
    if (!groups.empty())
      mesh_.intake->note(
          "a label is one physical group: where there is another one before them, "
          "these are left out: " +
          shownLabelNames(groups));
  }

  // Names of volumes' and surfaces' groups, where those label cells and faces.
  void nameGroups() {
    noteFurtherGroups();
    std::vector<LabelName> names;
    uint64_t left_out = 0;
    const std::string& physical = mesh_.hints.physical;
    for (const auto& [key, name] : mesh_.names) {
      const auto [dimension, tag] = key;
      const auto is = [dimension = dimension](int d) {
        return dimension == d || dimension == kAnyDimension;
      };
      const bool of_cells = is(3) && !physical.empty();
      const bool of_faces = is(2) && mesh_.face_labels == MshMesh::FaceLabels::kGroups;
      if (of_cells) names.push_back({physical, mesh_.labelOf(3, tag), name});
      if (of_faces) names.push_back({"", mesh_.labelOf(2, tag), name});
      left_out += !of_cells && !of_faces;
    }
    if (left_out > 0)
      mesh_.intake->leaveOut("names of physical groups that label no cells or faces", left_out);
    mesh_.intake->nameLabels(std::move(names));
    if (const std::optional<double> time = data_.time()) mesh_.intake->mesh().setTime(*time);
  }

  const ReadOptions& options() const { return mesh_.options; }

  FileScan file_;
  MshMesh mesh_;
  MshData data_;
  bool is_version_1_ = false;
  bool is_again_ = false;  // the mesh that is read
};

}  // namespace

Input openMsh(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  Input input;
  input.indexed = MshReader(std::move(bytes), options).read();
  return input;
}

}  // namespace tetstream
