// simplify/select: the choice kernels for any processor, and the choice between the builds.
#include "choice_kernels.h"

#include "choice_kernels.inl"
#include "choice_kernels_v3.h"
#include "processor.h"

namespace tetstream {

#ifdef TETSTREAM_V3_KERNELS
static const bool has_v3 = processorHasV3();
#define TETSTREAM_BEST(kernel, ...) (has_v3 ? v3::kernel(__VA_ARGS__) : kernel##Of(__VA_ARGS__))
#else
#define TETSTREAM_BEST(kernel, ...) kernel##Of(__VA_ARGS__)
#endif

template <class S>
void relistEdges(const ChoiceTable& table, uint32_t v, const EdgeList<S>& edges) {
  TETSTREAM_BEST(relistEdges, table, v, edges);
}
template <class S>
void addEdges(const ChoiceTable& table, uint32_t v, const EdgeList<S>& edges) {
  TETSTREAM_BEST(addEdges, table, v, edges);
}
template <class S>
void replaceEdges(const ChoiceTable& table, uint32_t u, uint32_t v, const EdgeList<S>& edges) {
  TETSTREAM_BEST(replaceEdges, table, u, v, edges);
}
void refuseEdge(const ChoiceTable& table, uint32_t v, uint32_t w) {
  TETSTREAM_BEST(refuseEdge, table, v, w);
}
void reconsiderEdges(const ChoiceTable& table, uint32_t v) {
  TETSTREAM_BEST(reconsiderEdges, table, v);
}

template void relistEdges(const ChoiceTable&, uint32_t, const EdgeList<float>&);
template void relistEdges(const ChoiceTable&, uint32_t, const EdgeList<double>&);
template void addEdges(const ChoiceTable&, uint32_t, const EdgeList<float>&);
template void addEdges(const ChoiceTable&, uint32_t, const EdgeList<double>&);
template void replaceEdges(const ChoiceTable&, uint32_t, uint32_t, const EdgeList<float>&);
template void replaceEdges(const ChoiceTable&, uint32_t, uint32_t, const EdgeList<double>&);

}  // namespace tetstream
