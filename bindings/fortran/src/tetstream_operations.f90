! What is done in one call: to arrays, to files, to readers and writers.
module tetstream_operations
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_arrays
  use tetstream_collecting
  use tetstream_failures
  use tetstream_figures
  use tetstream_listening
  use tetstream_readers
  use tetstream_settings
  use tetstream_simplifiers
  use tetstream_streams
  use tetstream_writers
  implicit none
  private
  public :: tetstream_convert, tetstream_format_at, tetstream_inspect, tetstream_layout
  public :: tetstream_library_version, tetstream_read, tetstream_simplify, tetstream_simplify_file
  public :: tetstream_status_name, tetstream_version_text, tetstream_write

  ! A row of the table of file formats.
  type, public :: tetstream_format
    character(:), allocatable :: name, extensions, text
    logical :: can_read = .false., can_write = .false.
  end type

  ! Arrays in, a mesh out.
  interface tetstream_simplify
    module procedure simplify_mesh
    module procedure simplify_float64_int64, simplify_float64_int32
    module procedure simplify_float32_int64, simplify_float32_int32
  end interface

contains

  ! ------------------------------------------------------------------------------ one-call forms

  subroutine simplify_float64_int64(points, cells, fields, result, options, ratio, cell_data, marks, map, &
                                      report, progress, stat, errmsg)
    real(c_double), contiguous, intent(in), target :: points(:, :)
    integer(c_int64_t), contiguous, intent(in), target :: cells(:, :)
    type(tetstream_field), intent(in) :: fields(:)
    type(tetstream_mesh), intent(out) :: result
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_field), intent(in), optional :: cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    type(tetstream_map), intent(out), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_mesh(points, cells, fields, cell_data, marks, status, sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    call simplify_into(reader, size(points, 2, c_int64_t), result, options, ratio, map, report, progress, &
                       stat, errmsg)
  end subroutine

  subroutine simplify_float64_int32(points, cells, fields, result, options, ratio, cell_data, marks, map, &
                                      report, progress, stat, errmsg)
    real(c_double), contiguous, intent(in), target :: points(:, :)
    integer(c_int32_t), contiguous, intent(in), target :: cells(:, :)
    type(tetstream_field), intent(in) :: fields(:)
    type(tetstream_mesh), intent(out) :: result
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_field), intent(in), optional :: cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    type(tetstream_map), intent(out), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_mesh(points, cells, fields, cell_data, marks, status, sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    call simplify_into(reader, size(points, 2, c_int64_t), result, options, ratio, map, report, progress, &
                       stat, errmsg)
  end subroutine

  subroutine simplify_float32_int64(points, cells, fields, result, options, ratio, cell_data, marks, map, &
                                      report, progress, stat, errmsg)
    real(c_float), contiguous, intent(in), target :: points(:, :)
    integer(c_int64_t), contiguous, intent(in), target :: cells(:, :)
    type(tetstream_field), intent(in) :: fields(:)
    type(tetstream_mesh), intent(out) :: result
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_field), intent(in), optional :: cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    type(tetstream_map), intent(out), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_mesh(points, cells, fields, cell_data, marks, status, sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    call simplify_into(reader, size(points, 2, c_int64_t), result, options, ratio, map, report, progress, &
                       stat, errmsg)
  end subroutine

  subroutine simplify_float32_int32(points, cells, fields, result, options, ratio, cell_data, marks, map, &
                                      report, progress, stat, errmsg)
    real(c_float), contiguous, intent(in), target :: points(:, :)
    integer(c_int32_t), contiguous, intent(in), target :: cells(:, :)
    type(tetstream_field), intent(in) :: fields(:)
    type(tetstream_mesh), intent(out) :: result
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_field), intent(in), optional :: cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    type(tetstream_map), intent(out), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_mesh(points, cells, fields, cell_data, marks, status, sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    call simplify_into(reader, size(points, 2, c_int64_t), result, options, ratio, map, report, progress, &
                       stat, errmsg)
  end subroutine

  ! The same of a whole mesh.
  subroutine simplify_mesh(mesh, result, options, ratio, map, report, progress, stat, errmsg)
    class(tetstream_mesh), intent(in), target :: mesh
    type(tetstream_mesh), intent(out) :: result
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_map), intent(out), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_mesh(mesh, status, sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    call simplify_into(reader, size(mesh%points, 2, c_int64_t), result, options, ratio, map, report, progress, &
                       stat, errmsg)
  end subroutine

  subroutine simplify_into(reader, points, result, options, ratio, map, report, progress, stat, errmsg)
    type(tetstream_reader), intent(inout) :: reader
    integer(c_int64_t), intent(in) :: points
    type(tetstream_mesh), intent(inout) :: result
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_map), intent(inout), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(collector), target :: taken
    type(tetstream_writer) :: writer
    character(sentence_length) :: sentence
    integer :: status

    if (present(map)) then
      allocate (map%cells(points), source=0_c_int64_t)
      allocate (map%weights(4, points), source=0._c_double)
    end if
    call writer%create(taken, status, sentence)
    if (status >= 0) call simplify(reader, writer, options, ratio, map, report, progress, status, sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    call hand_over(taken%mesh, result)
  end subroutine

  ! A file into a file.
  subroutine tetstream_simplify_file(source, target, options, ratio, report, progress, stat, errmsg)
    character(*), intent(in) :: source, target
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_file(source, options=options, progress=progress, stat=status, errmsg=sentence)
    if (status >= 0) call writer%create_file(target, stat=status, errmsg=sentence)
    if (status >= 0) call simplify(reader, writer, options, ratio, report=report, progress=progress, &
                                   stat=status, errmsg=sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
  end subroutine

  ! From a reader to a writer. A ratio stands in the place of options.
  subroutine simplify(reader, writer, options, ratio, map, report, progress, stat, errmsg)
    type(tetstream_reader), intent(inout) :: reader
    type(tetstream_writer), intent(inout), target :: writer
    type(tetstream_options), intent(in), optional :: options
    real(c_double), intent(in), optional :: ratio
    type(tetstream_map), intent(inout), target, optional :: map
    type(tetstream_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out) :: stat
    character(*), intent(inout) :: errmsg
    type(tetstream_simplifier) :: simplifier
    type(tetstream_options) :: only_ratio

    if (present(options) .and. present(ratio)) then
      call fail(TETSTREAM_BAD_ARGUMENT, "give options or a ratio, not both", stat, errmsg)
      return
    end if
    stat = TETSTREAM_OK
    if (present(ratio)) then
      call only_ratio%set(TETSTREAM_OPTION_RATIO, ratio, stat, errmsg)
      if (stat >= 0) call simplifier%create(writer, only_ratio, stat, errmsg)
    else
      call simplifier%create(writer, options, stat, errmsg)
    end if
    if (stat >= 0 .and. present(progress)) call simplifier%set_progress(progress, stat, errmsg)
    if (stat >= 0 .and. present(map)) call simplifier%set_map(map, stat, errmsg)
    if (stat >= 0) call simplifier%run(reader, stat, errmsg)
    if (stat >= 0 .and. present(report)) call simplifier%get_report(report)
  end subroutine

  subroutine hand_over(from, to)
    type(tetstream_mesh), intent(inout) :: from, to

    call move_alloc(from%points, to%points)
    call move_alloc(from%cells, to%cells)
    call move_alloc(from%fields, to%fields)
    call move_alloc(from%cell_data, to%cell_data)
    call move_alloc(from%locked, to%locked)
    call move_alloc(from%faces, to%faces)
    call move_alloc(from%face_labels, to%face_labels)
    call move_alloc(from%locked_faces, to%locked_faces)
    call move_alloc(from%locked_edges, to%locked_edges)
    call move_alloc(from%label_names, to%label_names)
    call move_alloc(from%time, to%time)
  end subroutine

  ! ------------------------------------------------------------------------------- whole meshes

  ! A whole file as a mesh. An indexed mesh is brought into an order. `info` is what is known of the
  ! stream, the front among it.
  subroutine tetstream_read(path, mesh, format, options, info, stat, errmsg)
    character(*), intent(in) :: path
    type(tetstream_mesh), intent(out) :: mesh
    character(*), intent(in), optional :: format
    type(tetstream_options), intent(in), optional :: options
    type(tetstream_stream_info), intent(inout), optional :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    type(collector), target :: taken
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_file(path, format, options, stat=status, errmsg=sentence)
    if (status >= 0) call writer%create(taken, status, sentence)
    if (status >= 0) call tetstream_convert(reader, writer, options, stat=status, errmsg=sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
    if (present(info)) info = taken%info
    call hand_over(taken%mesh, mesh)
  end subroutine

  ! A mesh into a file, brought into an order.
  subroutine tetstream_write(path, mesh, format, options, stat, errmsg)
    character(*), intent(in) :: path
    class(tetstream_mesh), intent(in), target :: mesh
    character(*), intent(in), optional :: format
    type(tetstream_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    character(sentence_length) :: sentence
    integer :: status

    call reader%open_mesh(mesh, status, sentence)
    if (status >= 0) call writer%create_file(path, format, status, sentence)
    if (status >= 0) call tetstream_convert(reader, writer, options, stat=status, errmsg=sentence)
    if (forwarded(status, sentence, stat, errmsg)) return
  end subroutine

  ! -------------------------------------------------------------------------- without simplifying

  subroutine tetstream_convert(reader, writer, options, progress, stat, errmsg)
    type(tetstream_reader), intent(inout) :: reader
    type(tetstream_writer), intent(inout) :: writer
    type(tetstream_options), intent(in), optional :: options
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(listener), target :: listens
    integer(c_int32_t) :: status

    if (present(progress)) listens%told => progress
    status = c_convert(reader%handle, writer%handle, handle_of(options), callback_of(listens), user_of(listens))
    call told(status, reader, writer, stat, errmsg)
  end subroutine

  ! Brings a mesh into the order that the options name.
  subroutine tetstream_layout(reader, writer, options, report, progress, stat, errmsg)
    type(tetstream_reader), intent(inout) :: reader
    type(tetstream_writer), intent(inout) :: writer
    type(tetstream_options), intent(in), optional :: options
    type(tetstream_layout_report), intent(inout), optional :: report
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(listener), target :: listens
    type(c_layout_report) :: found
    integer(c_int32_t) :: status

    if (present(progress)) listens%told => progress
    found%struct_size = c_sizeof(found)
    status = c_layout(reader%handle, writer%handle, handle_of(options), callback_of(listens), user_of(listens), found)
    if (status >= 0 .and. present(report)) call take(found, report)
    call told(status, reader, writer, stat, errmsg)
  end subroutine

  ! Reads everything: counts, box and front.
  subroutine tetstream_inspect(reader, info, options, progress, stat, errmsg)
    type(tetstream_reader), intent(inout) :: reader
    type(tetstream_stream_info), intent(out) :: info
    type(tetstream_options), intent(in), optional :: options
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(listener), target :: listens
    type(c_stream_info) :: found
    integer(c_int32_t) :: status

    if (present(progress)) listens%told => progress
    found%struct_size = c_sizeof(found)
    status = c_inspect(reader%handle, handle_of(options), callback_of(listens), user_of(listens), found)
    if (status >= 0) call copy_info(found, info)
    call settle(status, c_reader_message(reader%handle), stat, errmsg, reader%cause())
  end subroutine

  subroutine told(status, reader, writer, stat, errmsg)
    integer(c_int32_t), intent(in) :: status
    type(tetstream_reader), intent(in) :: reader
    type(tetstream_writer), intent(in) :: writer
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call settle(status, c_writer_message(writer%handle), stat, errmsg, trim(reader%cause())//writer%cause())
  end subroutine

  ! ------------------------------------------------------------------------------------- tables

  ! Row `index` of the table of file formats, from 1; TETSTREAM_BAD_ARGUMENT past the end.
  subroutine tetstream_format_at(index, format, stat, errmsg)
    integer, intent(in) :: index
    type(tetstream_format), intent(out) :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: name, extensions, text
    integer(c_int32_t) :: reads, writes, status

    status = c_format_at(index - 1, name, extensions, text, reads, writes)
    if (status >= 0) then
      format%name = text_of(name)
      format%extensions = text_of(extensions)
      format%text = text_of(text)
      format%can_read = reads /= 0
      format%can_write = writes /= 0
    end if
    call settle(status, c_null_ptr, stat, errmsg)
  end subroutine

  ! "TETSTREAM_BAD_DATA".
  function tetstream_status_name(status) result(name)
    integer, intent(in) :: status
    character(:), allocatable :: name

    name = text_of(c_status_name(status))
  end function

  ! TETSTREAM_VERSION_NUMBER of the library that runs; the constant is that of the module.
  integer function tetstream_library_version()
    tetstream_library_version = c_version_number()
  end function

  function tetstream_version_text() result(text)
    character(:), allocatable :: text

    text = text_of(c_version_text())
  end function

end module
