// simplify/select: the choice kernels for x86-64-v3 processors; this file alone is compiled for
// them.
#ifdef TETSTREAM_V3_KERNELS
#include "choice_kernels_v3.h"
#include "choice_kernels.inl"

namespace tetstream::v3 {

void relistEdges(const ChoiceTable& table, uint32_t v, const EdgeList<float>& edges) {
  relistEdgesOf(table, v, edges);
}
void relistEdges(const ChoiceTable& table, uint32_t v, const EdgeList<double>& edges) {
  relistEdgesOf(table, v, edges);
}
void addEdges(const ChoiceTable& table, uint32_t v, const EdgeList<float>& edges) {
  addEdgesOf(table, v, edges);
}
void addEdges(const ChoiceTable& table, uint32_t v, const EdgeList<double>& edges) {
  addEdgesOf(table, v, edges);
}
void replaceEdges(const ChoiceTable& table, uint32_t u, uint32_t v, const EdgeList<float>& edges) {
  replaceEdgesOf(table, u, v, edges);
}
void replaceEdges(const ChoiceTable& table, uint32_t u, uint32_t v, const EdgeList<double>& edges) {
  replaceEdgesOf(table, u, v, edges);
}
void refuseEdge(const ChoiceTable& table, uint32_t v, uint32_t w) {
  refuseEdgeOf(table, v, w);
}
void reconsiderEdges(const ChoiceTable& table, uint32_t v) {
  reconsiderEdgesOf(table, v);
}

}  // namespace tetstream::v3
#endif
