// stream KIND CELLS float32|float64 FIELD...: the mesh that `tetstream generate` makes, with
// positions and fields of that type and those fields only, to standard output as uncompressed
// .tets. What memory a simplification takes depends on both, and the command makes one mesh only.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "generate.h"
#include "registry.h"
#include "status.h"
#include "tets_format.h"

namespace tetstream {
namespace {

class Retyped final : public Source {
 public:
  Retyped(Source& in, ScalarType type, const std::vector<std::string>& names)
      : in_(in), schema_(in.schema()) {
    schema_.position_type = type;
    schema_.fields.clear();
    schema_.box_min.resize(3);
    schema_.box_max.resize(3);
    for (const std::string& name : names) keep(name, type);
    fields_.resize(kept_.size());
    pointers_.resize(kept_.size());
  }

  const Schema& schema() const override { return schema_; }

  bool next(BatchView& batch) override {
    if (!in_.next(batch)) return false;
    const size_t rows = batch.vertex_count;
    for (size_t i = 0; i < kept_.size(); ++i) {
      const Column& from = in_.schema().fields[kept_[i]];
      const size_t numbers = rows * static_cast<size_t>(from.components);
      pointers_[i] =
          converted(rows ? batch.fields[kept_[i]] : nullptr, from.type, numbers, fields_[i]);
    }
    batch.positions = converted(batch.positions, in_.schema().position_type, 3 * rows, positions_);
    batch.fields = pointers_.data();
    return true;
  }

 private:
  using Bytes = std::vector<unsigned char>;

  void keep(const std::string& name, ScalarType type) {
    const Schema& all = in_.schema();
    size_t first = 3;  // of the field's components in the box
    for (size_t i = 0; i < all.fields.size(); ++i) {
      const size_t end = first + static_cast<size_t>(all.fields[i].components);
      if (all.fields[i].name != name) {
        first = end;
        continue;
      }
      for (; first < end; ++first) {
        schema_.box_min.push_back(all.box_min[first]);
        schema_.box_max.push_back(all.box_max[first]);
      }
      kept_.push_back(i);
      schema_.fields.push_back(all.fields[i]);
      schema_.fields.back().type = type;
      return;
    }
    fail(Status::kBadArgument, "there is no field %s", name.c_str());
  }

  const void* converted(const void* in, ScalarType from, size_t numbers, Bytes& out) const {
    out.resize(numbers * sizeOf(schema_.position_type));
    if (numbers) convertScalars(in, from, out.data(), schema_.position_type, numbers);
    return out.data();
  }

  Source& in_;
  Schema schema_;
  std::vector<size_t> kept_;
  Bytes positions_;
  std::vector<Bytes> fields_;
  std::vector<const void*> pointers_;
};

void run(char** words, int count) {
  const std::string type = words[2];
  if (type != "float32" && type != "float64")
    fail(Status::kBadArgument, "neither float32 nor float64: %s", type.c_str());
  const auto mesh = generate(words[0], std::atoll(words[1]), 1);
  Retyped source(*mesh, type == "float64" ? ScalarType::kFloat64 : ScalarType::kFloat32,
                 {words + 3, words + count});
  WriteOptions options;
  options.compress = false;
  const auto sink = createTets(createDescriptor(STDOUT_FILENO, "standard output"), options);
  copyStream(source, *sink);
}

}  // namespace
}  // namespace tetstream

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: stream KIND CELLS float32|float64 FIELD...\n", stderr);
    return 1;
  }
  try {
    tetstream::run(argv + 1, argc - 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stream: %s\n", error.what());
    return 1;
  }
  return 0;
}
