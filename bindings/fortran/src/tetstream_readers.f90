! Readers: where a mesh comes from. A source of the caller's is a type that extends tetstream_source.
module tetstream_readers
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_arrays
  use tetstream_failures
  use tetstream_figures
  use tetstream_handover
  use tetstream_lending
  use tetstream_listening
  use tetstream_settings
  use tetstream_streams
  implicit none
  private

  ! A stream of the caller's. A procedure that fails sets `stat`, not to 0, and a sentence.
  type, abstract, public :: tetstream_source
  contains
    procedure(tetstream_describe), deferred :: open  ! called once, first: what the stream carries
    procedure(tetstream_give), deferred :: next      ! gives a batch; an empty one ends the stream
    procedure :: close => source_close               ! called once if open was, whatever happened since
  end type

  abstract interface
    subroutine tetstream_describe(this, info, stat, errmsg)
      import :: tetstream_source, tetstream_stream_info
      class(tetstream_source), intent(inout) :: this
      type(tetstream_stream_info), intent(inout) :: info
      integer, intent(inout) :: stat
      character(*), intent(inout) :: errmsg
    end subroutine
    subroutine tetstream_give(this, batch, stat, errmsg)
      import :: tetstream_source, tetstream_batch
      class(tetstream_source), intent(inout) :: this
      type(tetstream_batch), intent(inout) :: batch
      integer, intent(inout) :: stat
      character(*), intent(inout) :: errmsg
    end subroutine
  end interface

  ! What the callbacks of C see of a source, and what must live as long as a reader of arrays.
  type :: reader_room
    class(tetstream_source), pointer :: source => null()
    type(info_room) :: description
    type(batch_room) :: events
    type(lent_room) :: lent
    character(sentence_length) :: cause = ""  ! what the caller's procedure told
  end type

  type, public :: tetstream_reader
    type(c_ptr) :: handle = c_null_ptr
    type(reader_room), pointer, private :: room => null()
  contains
    procedure :: create => reader_create
    procedure :: open_file => reader_open_file
    procedure :: open_result => reader_open_result
    procedure :: open_fd => reader_open_fd
    procedure :: open_memory => reader_open_memory
    procedure :: generate => reader_generate
    procedure, private :: open_mesh_whole
    procedure, private :: open_mesh_float64_int64, open_mesh_float64_int32
    procedure, private :: open_mesh_float32_int64, open_mesh_float32_int32
    generic :: open_mesh => open_mesh_whole, open_mesh_float64_int64, open_mesh_float64_int32, &
      open_mesh_float32_int64, open_mesh_float32_int32
    procedure :: get_info => reader_get_info
    procedure :: get_front => reader_get_front
    procedure :: get_face_label => reader_get_face_label
    procedure :: note => reader_note
    procedure :: cause => reader_cause
    procedure :: destroy => reader_destroy
    procedure, private :: reader_copy
    generic :: assignment(=) => reader_copy
    final :: reader_final
  end type

contains

  ! ------------------------------------------------------------------------- the caller's source

  ! The source must be a target, and live and stay in its place until the reader is destroyed.
  subroutine reader_create(this, source, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    class(tetstream_source), intent(inout), target :: source
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_reader_callbacks) :: callbacks

    call prepare(this)
    this%room%source => source
    callbacks%struct_size = c_sizeof(callbacks)
    callbacks%user = c_loc(this%room)
    callbacks%open = c_funloc(open_source)
    callbacks%next = c_funloc(next_of_source)
    callbacks%close = c_funloc(close_source)
    call told(this, c_reader_create(callbacks, this%handle), stat, errmsg)
  end subroutine

  subroutine source_close(this)
    class(tetstream_source), intent(inout) :: this

    associate (unused => this)
    end associate
  end subroutine

  function open_source(user, info) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_stream_info), intent(inout) :: info
    integer(c_int32_t) :: stopped
    type(reader_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    room%description%info = tetstream_stream_info()
    call room%source%open(room%description%info, stat, room%cause)
    if (stat == 0) call room%description%fill(info, stat, room%cause)
    stopped = stat
  end function

  function next_of_source(user, batch) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_batch), intent(inout) :: batch
    integer(c_int32_t) :: stopped
    type(reader_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    room%events%batch = tetstream_batch()
    call room%source%next(room%events%batch, stat, room%cause)
    if (stat == 0) call room%events%fill(room%description%info, batch, stat, room%cause)
    stopped = stat
  end function

  subroutine close_source(user) bind(c)
    type(c_ptr), value :: user
    type(reader_room), pointer :: room

    call c_f_pointer(user, room)
    call room%source%close()
  end subroutine

  ! What a source told when it stopped a run, or "".
  function reader_cause(this) result(cause)
    class(tetstream_reader), intent(in) :: this
    character(sentence_length) :: cause

    cause = ""
    if (associated(this%room)) cause = this%room%cause
  end function

  ! -------------------------------------------------------------------------- files and memory

  ! `progress` is told how far opening is, where that takes long.
  subroutine reader_open_file(this, path, format, options, progress, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: format
    type(tetstream_options), intent(in), optional :: options
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call open_path(c_reader_open_file_with, this, path, format, options, progress, stat, errmsg)
  end subroutine

  ! A file to be compared with another that is opened with these options.
  subroutine reader_open_result(this, path, format, options, progress, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: format
    type(tetstream_options), intent(in), optional :: options
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call open_path(c_reader_open_result, this, path, format, options, progress, stat, errmsg)
  end subroutine

  subroutine open_path(open, this, path, format, options, progress, stat, errmsg)
    procedure(c_reader_open_result) :: open
    class(tetstream_reader), intent(inout) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: format
    type(tetstream_options), intent(in), optional :: options
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:, kind=c_char), allocatable :: kind
    type(tetstream_options), target :: own
    type(listener), target :: listens
    type(c_ptr) :: settings
    integer(c_int32_t) :: status, unheard

    call prepare(this)
    call terminated(format, kind)
    settings = handle_of(options)
    if (present(progress)) then
      listens%told => progress
      if (.not. c_associated(settings)) unheard = c_options_create(own%handle)
      if (.not. c_associated(settings)) settings = own%handle
      unheard = c_options_set_progress(settings, callback_of(listens), user_of(listens))
    end if
    status = open(trim(path)//c_null_char, kind, settings, this%handle)
    if (present(progress)) unheard = c_options_set_progress(settings, c_null_funptr, c_null_ptr)
    call told(this, status, stat, errmsg)
  end subroutine

  ! A descriptor of the system, which stays the caller's to close.
  subroutine reader_open_fd(this, fd, format, options, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    integer, intent(in) :: fd
    character(*), intent(in) :: format
    type(tetstream_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call prepare(this)
    call told(this, c_reader_open_fd_with(fd, trim(format)//c_null_char, handle_of(options), this%handle), &
              stat, errmsg)
  end subroutine

  ! The bytes of a file, which must stay until the reader is destroyed.
  subroutine reader_open_memory(this, bytes, format, options, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    integer(c_int8_t), pointer, contiguous, intent(in) :: bytes(:)
    character(*), intent(in) :: format
    type(tetstream_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: place

    call prepare(this)
    place = c_null_ptr
    if (size(bytes) > 0) place = c_loc(bytes)
    call told(this, c_reader_open_memory_with(place, size(bytes, kind=c_size_t), trim(format)//c_null_char, &
                                              handle_of(options), this%handle), stat, errmsg)
  end subroutine

  ! "fluid", "ball", "fluid+stress" or "ball+stress", of about so many cells.
  subroutine reader_generate(this, kind, cells, seed, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    character(*), intent(in) :: kind
    integer(c_int64_t), intent(in) :: cells
    integer(c_int64_t), intent(in), optional :: seed
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: start

    call prepare(this)
    start = 1
    if (present(seed)) start = seed
    call told(this, c_reader_generate(trim(kind)//c_null_char, cells, start, this%handle), stat, errmsg)
  end subroutine

  ! ------------------------------------------------------------------------- a mesh in arrays

  ! Points (3, n), cells (4, m) from 1, fields and cell data are read where they lie: they must stay
  ! until the reader is destroyed. Of `marks` count locked, faces, face_labels, locked_faces,
  ! locked_edges, label_names and time, which are copied.
  subroutine open_mesh_float64_int64(this, points, cells, fields, cell_data, marks, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    real(c_double), pointer, contiguous, intent(in) :: points(:, :)
    integer(c_int64_t), pointer, contiguous, intent(in) :: cells(:, :)
    type(tetstream_field), intent(in), optional :: fields(:), cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call lend_mesh(this, tetstream_field("points", points), tetstream_field("cells", cells), fields, &
                   cell_data, marks, stat, errmsg)
  end subroutine

  subroutine open_mesh_float64_int32(this, points, cells, fields, cell_data, marks, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    real(c_double), pointer, contiguous, intent(in) :: points(:, :)
    integer(c_int32_t), pointer, contiguous, intent(in) :: cells(:, :)
    type(tetstream_field), intent(in), optional :: fields(:), cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call lend_mesh(this, tetstream_field("points", points), tetstream_field("cells", cells), fields, &
                   cell_data, marks, stat, errmsg)
  end subroutine

  subroutine open_mesh_float32_int64(this, points, cells, fields, cell_data, marks, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    real(c_float), pointer, contiguous, intent(in) :: points(:, :)
    integer(c_int64_t), pointer, contiguous, intent(in) :: cells(:, :)
    type(tetstream_field), intent(in), optional :: fields(:), cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call lend_mesh(this, tetstream_field("points", points), tetstream_field("cells", cells), fields, &
                   cell_data, marks, stat, errmsg)
  end subroutine

  subroutine open_mesh_float32_int32(this, points, cells, fields, cell_data, marks, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    real(c_float), pointer, contiguous, intent(in) :: points(:, :)
    integer(c_int32_t), pointer, contiguous, intent(in) :: cells(:, :)
    type(tetstream_field), intent(in), optional :: fields(:), cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call lend_mesh(this, tetstream_field("points", points), tetstream_field("cells", cells), fields, &
                   cell_data, marks, stat, errmsg)
  end subroutine

  ! The same of a mesh that the caller keeps; it must be a target.
  subroutine open_mesh_whole(this, mesh, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    class(tetstream_mesh), intent(in), target :: mesh
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: points(:, :)
    integer(c_int64_t), pointer, contiguous :: cells(:, :)

    if (.not. allocated(mesh%points) .or. .not. allocated(mesh%cells)) then
      call fail(TETSTREAM_BAD_ARGUMENT, "a mesh needs points and cells", stat, errmsg)
      return
    end if
    points => mesh%points
    cells => mesh%cells
    call lend_mesh(this, tetstream_field("points", points), tetstream_field("cells", cells), &
                   lent_arrays(mesh%fields), lent_arrays(mesh%cell_data), mesh, stat, errmsg)
  end subroutine

  function lent_arrays(arrays) result(fields)
    type(tetstream_array), allocatable, intent(in), target :: arrays(:)
    type(tetstream_field), allocatable :: fields(:)
    integer :: i

    allocate (fields(0))
    if (.not. allocated(arrays)) return
    deallocate (fields)
    allocate (fields(size(arrays)))
    do i = 1, size(arrays)
      fields(i) = tetstream_field(arrays(i)%name, arrays(i)%components(), arrays(i)%type(), arrays(i)%rows(), &
                                  arrays(i)%location())
    end do
  end function

  subroutine lend_mesh(this, points, cells, fields, cell_data, marks, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    type(tetstream_field), intent(in) :: points, cells
    type(tetstream_field), intent(in), optional :: fields(:), cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_stream_info) :: info
    type(c_batch) :: batch
    character(sentence_length) :: refusal
    integer :: status

    call prepare(this)
    status = TETSTREAM_OK
    call this%room%lent%fill(points, cells, fields, cell_data, marks, info, batch, status, refusal)
    if (status < 0) then
      call fail(status, refusal, stat, errmsg)
    else
      call told(this, c_reader_open_mesh(info, batch, this%handle), stat, errmsg)
    end if
  end subroutine

  ! ---------------------------------------------------------------------------------- the rest

  subroutine reader_get_info(this, info, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    type(tetstream_stream_info), intent(out) :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_stream_info) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_reader_get_info(this%handle, found)
    if (status >= 0) call copy_info(found, info)
    call told(this, status, stat, errmsg)
  end subroutine

  ! The front, once tetstream_inspect has read the stream.
  subroutine reader_get_front(this, front, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    type(tetstream_front_info), intent(inout) :: front
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_front_info) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_reader_get_front(this%handle, found)
    if (status >= 0) call take(found, front)
    call told(this, status, stat, errmsg)
  end subroutine

  ! The labels of faces, by label, from 1, once tetstream_inspect has read the stream.
  subroutine reader_get_face_label(this, index, label, stat, errmsg)
    class(tetstream_reader), intent(inout) :: this
    integer, intent(in) :: index
    type(tetstream_face_label_info), intent(inout) :: label
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_face_label_info) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_reader_get_face_label(this%handle, index - 1, found)
    if (status >= 0) call take(found, label)
    call told(this, status, stat, errmsg)
  end subroutine

  ! What was left out or assumed: sentence `index`, from 1; "" after the last one.
  function reader_note(this, index) result(note)
    class(tetstream_reader), intent(in) :: this
    integer, intent(in) :: index
    character(:), allocatable :: note

    note = text_of(c_reader_note(this%handle, index - 1))
  end function

  subroutine told(this, status, stat, errmsg)
    class(tetstream_reader), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call settle(status, c_reader_message(this%handle), stat, errmsg, this%cause())
  end subroutine

  subroutine prepare(this)
    class(tetstream_reader), intent(inout) :: this

    call this%destroy()
    allocate (this%room)
  end subroutine

  subroutine reader_destroy(this)
    class(tetstream_reader), intent(inout) :: this

    call c_reader_destroy(this%handle)
    this%handle = c_null_ptr
    if (associated(this%room)) deallocate (this%room)
  end subroutine

  impure elemental subroutine reader_final(this)
    type(tetstream_reader), intent(inout) :: this

    call this%destroy()
  end subroutine

  subroutine reader_copy(this, other)
    class(tetstream_reader), intent(inout) :: this
    class(tetstream_reader), intent(in) :: other

    if (c_associated(this%handle) .or. c_associated(other%handle)) call refuse_copy("tetstream_reader")
  end subroutine

end module
