#include "target.h"

#include "status.h"

namespace tetstream {

Target targetOf(const Schema& schema, const SimplifyOptions& options) {
  Target target{options.ratio, options.error, options.cells};
  if (!(target.ratio > 0 || target.error > 0 || target.cells > 0)) target.ratio = kUsualRatio;
  if (target.cells > 0 && schema.cell_count < 0)
    fail(Status::kUnsupported,
         "a number of cells was asked for, but the stream does not say how many it has: give a "
         "ratio");
  const char* const mode = options.mode == Mode::kQueue ? "queue" : "paper";
  if (target.error > 0 && followsPaper(options.mode))
    fail(Status::kUnsupported, "mode \"%s\" knows no bound on the error", mode);
  if (target.error > 0 && options.quadric == QuadricForm::kGarlandZhou)
    fail(Status::kUnsupported, "quadric \"garland-zhou\" knows no bound on the error");
  if (options.shape == Shape::kSolver && followsPaper(options.mode))
    fail(Status::kUnsupported, "mode \"%s\" knows no shapes for solvers", mode);
  if (options.effort == Effort::kHigh && followsPaper(options.mode))
    fail(Status::kUnsupported, "mode \"%s\" knows no effort", mode);
  return target;
}

}  // namespace tetstream
