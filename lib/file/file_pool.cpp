#include "file_pool.h"

#include <utility>

#include "compressed_bytes.h"

namespace tetstream {

std::string pathBeside(const std::string& file, const std::string& name) {
  const size_t slash = file.find_last_of('/');
  return name[0] == '/' || slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

constexpr size_t kMostOpen = 64;

namespace {

class PooledFile final : public ByteSource {
 public:
  PooledFile(std::shared_ptr<FilePool> pool, size_t file, const std::string& path)
      : ByteSource(path), pool_(std::move(pool)), file_(file), size_(pool_->open(file).size()) {}
  size_t read(void* out, size_t size) override {
    const size_t got = readAt(place_, out, size);
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return pool_->open(file_).readAt(offset, out, size);
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return size_; }

 private:
  std::shared_ptr<FilePool> pool_;
  size_t file_;
  uint64_t size_, place_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> FilePool::add(const std::string& path) {
  paths_.push_back(path);
  files_.emplace_back();
  return std::make_unique<PooledFile>(shared_from_this(), paths_.size() - 1, path);
}

ByteSource& FilePool::open(size_t file) {
  if (!files_[file]) {
    if (opened_.size() == kMostOpen) {
      files_[opened_.front()].reset();
      opened_.pop_front();
    }
    std::unique_ptr<ByteSource> bytes = openFile(paths_[file]);
    if (bytes->seekable()) opened_.push_back(file);
    if (unwraps_) bytes = unwrapped(std::move(bytes));
    files_[file] = makeSeekable(std::move(bytes), temp_dir_);
  }
  return *files_[file];
}

}  // namespace tetstream
