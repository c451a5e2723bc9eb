#include "registry.h"

#include <cstring>

#include "compressed_bytes.h"
#include "exodus_format.h"
#include "gmsh_format.h"
#include "medit_format.h"
#include "status.h"
#include "su2_format.h"
#include "sv_format.h"
#include "tetgen_format.h"
#include "tets_format.h"
#include "vtk_format.h"
#include "xdmf_format.h"

namespace tetstream {

static const Format kFormats[] = {
    {.name = "tets",
     .extensions = ".tets",
     .text = "tetstream's own stream: any fields and cell data, checksums",
     .label_names = true,
     .time = true,
     .reads_pipes = true,
     .recovers = true,
     .open = openTets,
     .create = createTets},
    {.name = "vtu",
     .extensions = ".vtu",
     .text = "VTK XML unstructured grid",
     .time = true,
     .open = openVtu,
     .create = createVtu},
    {.name = "pvtu",
     .extensions = ".pvtu",
     .text = "pieces in .vtu files, of one parallel run",
     .open = openPvtu},
    {.name = "pvd",
     .extensions = ".pvd",
     .text = "time steps in .vtu and .pvtu files, of which one is read",
     .open = openPvd},
    {.name = "vtk",
     .extensions = ".vtk",
     .text = "legacy VTK unstructured grid; written binary",
     .time = true,
     .open = openVtk,
     .create = createVtk},
#ifdef TETSTREAM_WITH_HDF5
    {.name = "vtkhdf",
     .extensions = ".vtkhdf",
     .text = "VTK's unstructured grid in HDF5",
     .time = true,
     .open = openVtkHdf,
     .create = createVtkHdf},
#endif
    {.name = "exodus",
     .extensions = ".exo .ex2 .e .g",
     .text = "Exodus II, one time step; side sets label faces",
     .label_names = true,
     .time = true,
     .open = openExodus,
     .create = createExodus},
    {.name = "xdmf",
     .extensions = ".xdmf .xmf",
     .text = "XDMF 2 and 3, values in its text, in HDF5 or raw; one time step",
     .open = openXdmf},
    {.name = "sva",
     .extensions = ".sva",
     .text = "streaming volume mesh of Isenburg, text",
     .reads_pipes = true,
     .open = openSva,
     .create = createSva},
    {.name = "svb",
     .extensions = ".svb",
     .text = "streaming volume mesh of Isenburg, binary",
     .float32_only = true,
     .reads_pipes = true,
     .open = openSvb,
     .create = createSvb},
    {.name = "msh",
     .extensions = ".msh",
     .text = "Gmsh 4.1 and 2.2, binary and text",
     .label_names = true,
     .time = true,
     .reads_pipes = true,
     .open = openMsh,
     .create = createMsh},
    {.name = "mesh",
     .extensions = ".mesh",
     .text = "MEDIT, text; fields in a .sol file beside it",
     .reads_pipes = true,
     .open = openMedit,
     .create = createMesh},
    {.name = "meshb",
     .extensions = ".meshb",
     .text = "MEDIT, binary; fields in a .solb file beside it",
     .reads_pipes = true,
     .open = openMedit,
     .create = createMeshb},
    {.name = "tetgen",
     .extensions = ".node .ele",
     .text = "TetGen: points in .node, cells in .ele, faces in .face",
     .open = openTetgen},
    {.name = "su2", .extensions = ".su2", .text = "SU2", .reads_pipes = true, .open = openSu2},
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
  fail(Status::kUnsupported,
       "%s: the name does not tell the format, and none is given (--format, --format-in); there "
       "are %s",
       path.c_str(), known.c_str());
}

}  // namespace tetstream
