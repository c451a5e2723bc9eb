// The interface that all languages share. A language's module includes it after its own typemaps:
//   const char *path              the name of a file
//   const ArrayView &, ArrayView  an array that is lent for a call; one that is copied out
//   OwnedArray &                  an array that is handed over
//   const Function &              a function of the language, or its word for none
//   double [3]                    three coordinates
//   exceptions                    %exception: Failure, and what Function throws
// Names are those of the C functions and constants without their prefixes. Structs of figures are
// taken from tetstream.h itself, so that new members are there without a change here.
%{
#include "failure.h"
#include "handles.h"
%}

%include <stdint.i>

// ------------------------------------------------------------------------------------- names
%rename("%(undercase)s", %$isfunction) "";
%rename(set_int64) tetstream::swig::Options::setInt64;
%rename(get_int64) tetstream::swig::Options::getInt64;
%rename("%(strip:[TETSTREAM_])s", %$isconstant) "";
%rename(OptionInfo) tetstream_option_info;
%rename(Progress) tetstream_progress;
%rename(Report) tetstream_report;
%rename(LayoutReport) tetstream_layout_report;
%rename(FrontInfo) tetstream_front_info;
%rename(DiagramInfo) tetstream_diagram_info;
%rename(ComparisonInfo) tetstream_comparison_info;
%rename(MeshFigures) tetstream_mesh_figures;
%rename(FieldComparison) tetstream_field_comparison;
%rename(RegionComparison) tetstream_region_comparison;
%rename(FaceLabelInfo) tetstream_face_label_info;
%rename(FaceLabelComparison) tetstream_face_label_comparison;

// --------------------------------------------------------------------------------- constants
// The functions of the header are there as methods; structs of pointers as classes.
%rename("$ignore", regextarget=1, fullname=1, %$isfunction) "^tetstream_";
%rename("$ignore", regextarget=1) "_callbacks$";
%ignore tetstream_column;
%ignore tetstream_label_name;
%ignore tetstream_batch;
%ignore tetstream_stream_info;
%ignore TETSTREAM_H;
%ignore TETSTREAM_API;
%ignore tetstream_map_rows;
%ignore tetstream_log_rows;
%rename("$ignore", regextarget=1) "^struct_size$";
%ignore tetstream_diagram_info::coverage;
%ignore tetstream_diagram_info::widths;
%ignore tetstream_diagram_info::lowest;
%ignore tetstream_diagram_info::newest;
%immutable;
%nodefaultctor;
%include <tetstream/version.h>
%include <tetstream/tetstream.h>
%clearnodefaultctor;
%mutable;

%rename(version_number) tetstream_version_number;
%rename(version_text) tetstream_version_text;
%rename(status_name) tetstream_status_name;
%rename(option_count) tetstream_option_count;
int32_t tetstream_version_number(void);
const char *tetstream_version_text(void);
const char *tetstream_status_name(int32_t status);
int32_t tetstream_option_count(void);

// ----------------------------------------------------------------------------------- handles
%newobject tetstream::swig::Reader::openFile;
%newobject tetstream::swig::Reader::openResult;
%newobject tetstream::swig::Reader::openMemory;
%newobject tetstream::swig::Reader::openMesh;
%newobject tetstream::swig::Reader::generate;
%newobject tetstream::swig::Reader::create;
%newobject tetstream::swig::Reader::getInfo;
%newobject tetstream::swig::Reader::inspect;
%newobject tetstream::swig::Writer::createFile;
%newobject tetstream::swig::Writer::createMemory;
%newobject tetstream::swig::Writer::create;
%newobject tetstream::swig::Writer::collect;
%rename("$ignore", regextarget=1, fullname=1) "::handle$";
%rename("$ignore", regextarget=1, fullname=1) "::callbacks$";
%ignore tetstream::swig::StreamInfo::StreamInfo(const tetstream_stream_info &);
%ignore tetstream::swig::StreamInfo::info;
%ignore tetstream::swig::StreamInfo::field;
%ignore tetstream::swig::StreamInfo::cellData;
%ignore tetstream::swig::StreamBatch::StreamBatch(const tetstream_batch &, const StreamInfo &);
%ignore tetstream::swig::StreamBatch::batch;
%ignore tetstream::swig::StreamBatch::cellType;
%ignore tetstream::swig::Destroy;
namespace tetstream::swig {
class Function;
class OwnedArray;
struct ArrayView;
}  // namespace tetstream::swig
%include "stream_info.h"
%include "stream_batch.h"
%include "mesh_collector.h"
%include "handles.h"
