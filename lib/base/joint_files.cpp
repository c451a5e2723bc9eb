#include "joint_files.h"

#include <string>

#include "status.h"

namespace tetstream {

static void needTwo(const NamedTemporary& a, const NamedTemporary& b) {
  if (a.target() == b.target())
    fail(Status::kBadArgument, "%s: two things cannot be written there", a.path().c_str());
}

void JointFiles::needDistinct() const {
  for (size_t i = 0; i < begun_.size(); ++i)
    for (size_t j = 0; j < i; ++j) needTwo(*begun_[i], *begun_[j]);
}

// The last rename needs no way back.
void JointFiles::prepare() {
  for (size_t i = 0; i < files_.size(); ++i)
    for (size_t j = 0; j < i; ++j) needTwo(*files_[i], *files_[j]);
  for (const auto& file : files_) file->sync();
  for (size_t i = 0; i + 1 < files_.size(); ++i) files_[i]->keepOld();
}

void JointFiles::commit() {
  size_t renamed = 0;
  try {
    if (files_.size() > 1) prepare();
    for (const auto& file : files_) file->close();
    for (; renamed < files_.size(); ++renamed) files_[renamed]->rename();
  } catch (const Error& error) {
    undo(renamed);
    const std::string text = error.text() + leftInWords();
    forget();
    throw Error(error.status(), text);
  } catch (...) {
    undo(renamed);
    forget();
    throw;
  }
  forget();
}

void JointFiles::undo(size_t renamed) noexcept {
  while (renamed-- > 0) files_[renamed]->undo();
}

std::string JointFiles::leftInWords() const {
  std::string words;
  for (const auto& file : files_)
    if (!file->left().empty())
      words += textOf("; %s is new already, what it was before is now %s", file->path().c_str(),
                      file->left().c_str());
  return words;
}

}  // namespace tetstream
