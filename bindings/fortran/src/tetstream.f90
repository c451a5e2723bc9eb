! tetstream for Fortran: what a program uses. See tetstream-fortran(3).
module tetstream
  use tetstream_constants
  use tetstream_figures
  use tetstream_arrays, only: tetstream_array, tetstream_field, tetstream_index, tetstream_real
  use tetstream_streams, only: tetstream_batch, tetstream_column, tetstream_mesh, tetstream_stream_info
  use tetstream_settings, only: tetstream_option_at, tetstream_option_count, tetstream_options
  use tetstream_readers, only: tetstream_reader, tetstream_source
  use tetstream_writers, only: tetstream_sink, tetstream_writer
  use tetstream_listening, only: tetstream_listen
  use tetstream_tracing, only: tetstream_log_rows, tetstream_log_sink, tetstream_map_rows, tetstream_map_sink
  use tetstream_simplifiers, only: tetstream_simplifier
  use tetstream_collecting, only: tetstream_map
  use tetstream_operations, only: tetstream_convert, tetstream_format, tetstream_format_at, tetstream_inspect, &
    tetstream_layout, tetstream_library_version, tetstream_read, tetstream_simplify, tetstream_simplify_file, &
    tetstream_status_name, tetstream_version_text, tetstream_write
  use tetstream_diagrams, only: tetstream_diagram, tetstream_raster
  use tetstream_comparisons, only: tetstream_comparison
  implicit none
  private :: take
end module
