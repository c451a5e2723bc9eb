#include "registry.h"

#include <cstring>

#include "compressed_bytes.h"
#include "status.h"

namespace tetstream {

static const Format kFormats[] = {
    {"tets",
     ".tets",
     "tetstream's own stream: any fields and cell data, checksums",
     {true, -1, true, true},
     true,
     true,
     openTets,
     createTets},
    {"vtu", ".vtu", "VTK XML unstructured grid", {true, -1, true}, false, true, openVtu, createVtu},
    {"pvtu",
     ".pvtu",
     "pieces in .vtu files, of one parallel run",
     {true, -1, true},
     false,
     false,
     openPvtu,
     nullptr},
    {"pvd",
     ".pvd",
     "time steps in .vtu and .pvtu files, of which one is read",
     {true, -1, true},
     false,
     false,
     openPvd,
     nullptr},
    {"vtk",
     ".vtk",
     "legacy VTK unstructured grid; written binary",
     {true, -1, true},
     false,
     true,
     openVtk,
     createVtk},
#ifdef TETSTREAM_WITH_HDF5
    {"vtkhdf",
     ".vtkhdf",
     "VTK's unstructured grid in HDF5",
     {true, -1, true},
     false,
     true,
     openVtkHdf,
     createVtkHdf},
#endif
    {"exodus",
     ".exo .ex2 .e .g",
     "Exodus II, one time step; side sets label faces",
     {true, -1, true, true},
     false,
     true,
     openExodus,
     createExodus},
    {"xdmf",
     ".xdmf .xmf",
     "XDMF 2 and 3, values in its text, in HDF5 or raw; one time step",
     {true, -1, true},
     false,
     false,
     openXdmf,
     nullptr},
    {"sva",
     ".sva",
     "streaming volume mesh of Isenburg, text",
     {true, -1, true},
     true,
     true,
     openSva,
     createSva},
    {"svb",
     ".svb",
     "streaming volume mesh of Isenburg, binary",
     {false, 1, false},
     true,
     true,
     openSvb,
     createSvb},
    {"msh",
     ".msh",
     "Gmsh 4.1 and 2.2, binary and text",
     {true, -1, true, true},
     true,
     true,
     openMsh,
     createMsh},
    {"mesh",
     ".mesh",
     "MEDIT, text; fields in a .sol file beside it",
     {true, -1, true},
     true,
     true,
     openMedit,
     createMesh},
    {"meshb",
     ".meshb",
     "MEDIT, binary; fields in a .solb file beside it",
     {true, -1, true},
     true,
     true,
     openMedit,
     createMeshb},
    {"tetgen",
     ".node .ele",
     "TetGen: points in .node, cells in .ele, faces in .face",
     {true, -1, true},
     false,
     false,
     openTetgen,
     nullptr},
    {"su2", ".su2", "SU2", {true, -1, true}, true, false, openSu2, nullptr},
};

const Format* formats(size_t* count) {
  *count = sizeof kFormats / sizeof kFormats[0];
  return kFormats;
}

const Format* findFormat(const std::string& name) {
  for (const Format& f : kFormats)
    if (name == f.name) return &f;
  return nullptr;
}

static bool listHas(const char* list, const std::string& word) {
  for (const char* at = list; *at;) {
    const size_t length = std::strcspn(at, " ");
    if (word.size() == length && word.compare(0, length, at, length) == 0) return true;
    at += length + (at[length] == ' ');
  }
  return false;
}

const Format* formatOfPath(const std::string& wrapped_path) {
  std::string path;
  wrappingOf(wrapped_path, &path);
  const size_t slash = path.find_last_of('/');
  const size_t dot = path.find_last_of('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return nullptr;
  std::string extension = path.substr(dot);
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const Format& f : kFormats)
    if (listHas(f.extensions, extension)) return &f;
  return nullptr;
}

const Format& needFormat(const std::string& name, const std::string& path, FormatUse use) {
  const Format* found = name.empty() ? formatOfPath(path) : findFormat(name);
  if (found) return *found;
  std::string known;
  for (const Format& f : kFormats)
    if (use == FormatUse::kReading || f.create)
      known += std::string(known.empty() ? "" : ", ") + f.name;
  if (!name.empty())
    fail(Status::kUnsupported, "there is no format \"%s\"; there are %s", name.c_str(),
         known.c_str());
  fail(Status::kUnsupported, "%s: the name does not tell the format; there are %s", path.c_str(),
       known.c_str());
}

}  // namespace tetstream
