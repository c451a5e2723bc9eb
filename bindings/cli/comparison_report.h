// cli: what a comparison tells. Depends on the public header.
#pragma once

#include <tetstream/tetstream.h>

#include <string>
#include <vector>

namespace tetstream::cli {

// Everything, as structs. The texts live as long as the comparison.
struct ComparisonFigures {
  tetstream_comparison_info info;
  tetstream_mesh_figures original, simplified;
  std::vector<tetstream_field_comparison> fields;
  std::vector<tetstream_region_comparison> regions;
  std::vector<tetstream_face_label_comparison> face_labels;
};

ComparisonFigures figuresOf(const tetstream_comparison* comparison);
std::string comparisonText(const ComparisonFigures& figures);
// One object with every member of the structs by its name, and the notes.
std::string comparisonJson(const ComparisonFigures& figures, const std::vector<std::string>& notes);

}  // namespace tetstream::cli
