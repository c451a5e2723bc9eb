// stream: names of labels, as readers find them and writers tell of them: sorted by array, those of
// faces first, and by label, each of which has one. Depends on schema.h.
#pragma once

#include <string>
#include <vector>

#include "schema.h"

namespace tetstream {

// Part of checkSchema, which sorts nothing.
void checkLabelNames(const Schema& schema);

// Sorts what came in any order; nothing is lost.
void sortLabelNames(std::vector<LabelName>& names);
// The same of a file's, of which the first of each label is kept, cut to 255 bytes, and those
// without a text are left out.
void settleLabelNames(std::vector<LabelName>& names);

// Of the labels of an array; "": of faces.
void removeLabelNames(std::vector<LabelName>& names, const std::string& array);

// Of one label, or null.
const LabelName* findLabelName(const std::vector<LabelName>& names, const std::string& array,
                               int64_t label);

// For a note: faces 1 "inlet", "material" 3 "steel" and 7 more.
std::string shownLabelNames(const std::vector<LabelName>& names);

}  // namespace tetstream
