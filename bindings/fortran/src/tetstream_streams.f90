! What a stream is made of: its description, its batches, and a whole mesh. Points are numbered from 1.
module tetstream_streams
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_arrays
  use tetstream_failures, only: text_of
  use tetstream_figures, only: take, tetstream_label_name
  implicit none
  private
  public :: copy_info, copy_batch

  ! A named array of a stream.
  type, public :: tetstream_column
    character(:), allocatable :: name
    integer :: components = 1
    integer :: type = TETSTREAM_TYPE_FLOAT64
  end type

  ! What a stream carries. Counts are -1 where they are not known.
  type, public :: tetstream_stream_info
    integer :: position_type = TETSTREAM_TYPE_FLOAT64
    logical :: indexed = .false.
    type(tetstream_column), allocatable :: fields(:), cell_data(:)
    integer(c_int64_t) :: vertex_count = -1, cell_count = -1, face_count = -1
    integer(c_int64_t) :: front_width = -1, front_span = -1, front_cells = -1
    real(c_double), allocatable :: box_min(:), box_max(:)
    type(tetstream_label_name), allocatable :: label_names(:)   ! of labels of faces: cell_array is ""
    real(c_double), allocatable :: time                         ! of the values, where it is known
  contains
    procedure :: add_field => info_add_field
    procedure :: add_cell_data => info_add_cell_data
    procedure, private :: info_add_name_int64, info_add_name_int32
    generic :: add_label_name => info_add_name_int64, info_add_name_int32
  end type

  ! A mesh in arrays; what it does not have is not allocated.
  type, public :: tetstream_mesh
    real(c_double), allocatable :: points(:, :)             ! (3, n)
    integer(c_int64_t), allocatable :: cells(:, :)          ! (4, m), from 1
    type(tetstream_array), allocatable :: fields(:)         ! (components, n) each
    type(tetstream_array), allocatable :: cell_data(:)      ! (components, m) each
    logical, allocatable :: locked(:)                       ! (n)
    integer(c_int64_t), allocatable :: faces(:, :)          ! (3, f), from 1
    integer(c_int64_t), allocatable :: face_labels(:)       ! (f)
    logical, allocatable :: locked_faces(:)                 ! (f)
    integer(c_int64_t), allocatable :: locked_edges(:, :)   ! (2, e), from 1
    type(tetstream_label_name), allocatable :: label_names(:)   ! of a batch they do not count, nor
    real(c_double), allocatable :: time                     ! does the time of the values
  contains
    procedure, private :: mesh_add_name_int64, mesh_add_name_int32
    generic :: add_label_name => mesh_add_name_int64, mesh_add_name_int32
    procedure :: field => mesh_field
    procedure :: cell_array => mesh_cell_array
  end type

  ! Some thousands of events of a stream: its points, then its cells with what they finalize, then what
  ! else is finalized.
  type, extends(tetstream_mesh), public :: tetstream_batch
    logical, allocatable :: last_uses(:, :)                 ! (4, m)
    integer(c_int64_t), allocatable :: finalized(:)         ! from 1
  end type

contains

  subroutine info_add_field(this, name, components, type)
    class(tetstream_stream_info), intent(inout) :: this
    character(*), intent(in) :: name
    integer, intent(in), optional :: components, type

    call add_column(this%fields, name, components, type)
  end subroutine

  subroutine info_add_cell_data(this, name, components, type)
    class(tetstream_stream_info), intent(inout) :: this
    character(*), intent(in) :: name
    integer, intent(in), optional :: components, type

    call add_column(this%cell_data, name, components, type)
  end subroutine

  subroutine add_column(columns, name, components, type)
    type(tetstream_column), allocatable, intent(inout) :: columns(:)
    character(*), intent(in) :: name
    integer, intent(in), optional :: components, type
    type(tetstream_column), allocatable :: more(:)
    integer :: count

    count = 0
    if (allocated(columns)) count = size(columns)
    allocate (more(count + 1))
    if (count > 0) more(:count) = columns
    more(count + 1)%name = trim(name)
    if (present(components)) more(count + 1)%components = components
    if (present(type)) more(count + 1)%type = type
    call move_alloc(more, columns)
  end subroutine

  ! What a label means: of a cell array, or of faces, without one.
  subroutine info_add_name_int64(this, label, name, cell_array)
    class(tetstream_stream_info), intent(inout) :: this
    integer(c_int64_t), intent(in) :: label
    character(*), intent(in) :: name
    character(*), intent(in), optional :: cell_array

    call add_name(this%label_names, label, name, cell_array)
  end subroutine

  subroutine info_add_name_int32(this, label, name, cell_array)
    class(tetstream_stream_info), intent(inout) :: this
    integer(c_int32_t), intent(in) :: label
    character(*), intent(in) :: name
    character(*), intent(in), optional :: cell_array

    call add_name(this%label_names, int(label, c_int64_t), name, cell_array)
  end subroutine

  subroutine mesh_add_name_int64(this, label, name, cell_array)
    class(tetstream_mesh), intent(inout) :: this
    integer(c_int64_t), intent(in) :: label
    character(*), intent(in) :: name
    character(*), intent(in), optional :: cell_array

    call add_name(this%label_names, label, name, cell_array)
  end subroutine

  subroutine mesh_add_name_int32(this, label, name, cell_array)
    class(tetstream_mesh), intent(inout) :: this
    integer(c_int32_t), intent(in) :: label
    character(*), intent(in) :: name
    character(*), intent(in), optional :: cell_array

    call add_name(this%label_names, int(label, c_int64_t), name, cell_array)
  end subroutine

  subroutine add_name(names, label, name, cell_array)
    type(tetstream_label_name), allocatable, intent(inout) :: names(:)
    integer(c_int64_t), intent(in) :: label
    character(*), intent(in) :: name
    character(*), intent(in), optional :: cell_array
    type(tetstream_label_name), allocatable :: more(:)
    integer :: count

    count = 0
    if (allocated(names)) count = size(names)
    allocate (more(count + 1))
    if (count > 0) more(:count) = names
    more(count + 1)%label = label
    more(count + 1)%name = trim(name)
    more(count + 1)%cell_array = ""
    if (present(cell_array)) more(count + 1)%cell_array = trim(cell_array)
    call move_alloc(more, names)
  end subroutine

  ! The place of a field in `fields`; 0: there is none of that name.
  pure integer function mesh_field(this, name)
    class(tetstream_mesh), intent(in) :: this
    character(*), intent(in) :: name

    mesh_field = 0
    if (allocated(this%fields)) mesh_field = place_of(this%fields, name)
  end function

  ! The same in `cell_data`.
  pure integer function mesh_cell_array(this, name)
    class(tetstream_mesh), intent(in) :: this
    character(*), intent(in) :: name

    mesh_cell_array = 0
    if (allocated(this%cell_data)) mesh_cell_array = place_of(this%cell_data, name)
  end function

  pure integer function place_of(arrays, name)
    type(tetstream_array), intent(in) :: arrays(:)
    character(*), intent(in) :: name

    do place_of = size(arrays), 1, -1
      if (arrays(place_of)%name == name) return
    end do
  end function

  ! --------------------------------------------------------------------------- copies of C's structs

  subroutine copy_info(from, to)
    type(c_stream_info), intent(in) :: from
    type(tetstream_stream_info), intent(out) :: to
    integer :: length

    to%position_type = from%position_type
    to%indexed = iand(from%flags, TETSTREAM_STREAM_INDEXED) /= 0
    call copy_columns(from%fields, from%field_count, to%fields)
    call copy_columns(from%cell_data, from%cell_data_count, to%cell_data)
    to%vertex_count = from%vertex_count
    to%cell_count = from%cell_count
    to%face_count = from%face_count
    to%front_width = from%front_width
    to%front_span = from%front_span
    to%front_cells = from%front_cells
    length = 3 + sum(to%fields%components)
    call copy_box(from%box_min, length, to%box_min)
    call copy_box(from%box_max, length, to%box_max)
    call copy_label_names(from, to%label_names)
    if (iand(from%flags, TETSTREAM_STREAM_TIMED) /= 0) to%time = from%time
  end subroutine

  subroutine copy_columns(from, count, to)
    type(c_ptr), intent(in) :: from
    integer(c_int32_t), intent(in) :: count
    type(tetstream_column), allocatable, intent(out) :: to(:)
    type(c_column), pointer :: columns(:)
    integer :: i

    allocate (to(count))
    if (count == 0) return
    call c_f_pointer(from, columns, [count])
    do i = 1, count
      to(i)%name = text_of(columns(i)%name)
      to(i)%components = columns(i)%components
      to(i)%type = columns(i)%type
    end do
  end subroutine

  subroutine copy_box(from, length, to)
    type(c_ptr), intent(in) :: from
    integer, intent(in) :: length
    real(c_double), allocatable, intent(out) :: to(:)
    real(c_double), pointer :: values(:)

    if (.not. c_associated(from)) return
    call c_f_pointer(from, values, [length])
    to = values
  end subroutine

  subroutine copy_label_names(from, to)
    type(c_stream_info), intent(in) :: from
    type(tetstream_label_name), allocatable, intent(out) :: to(:)
    type(c_label_name), pointer :: names(:)
    integer(c_int64_t) :: i

    allocate (to(from%label_name_count))
    if (from%label_name_count == 0) return
    call c_f_pointer(from%label_names, names, [from%label_name_count])
    do i = 1, from%label_name_count
      call take(names(i), to(i))
    end do
  end subroutine

  ! A batch of the library's, whose arrays live during a call.
  subroutine copy_batch(from, info, to)
    type(c_batch), intent(in) :: from
    type(tetstream_stream_info), intent(in) :: info
    type(tetstream_batch), intent(out) :: to

    call copy_points(from%positions, from%vertex_count, info%position_type, to%points)
    call copy_arrays(from%fields, from%vertex_count, info%fields, to%fields)
    call copy_flags(from%locked, from%vertex_count, to%locked)
    call copy_ids(from%cells, 4, from%cell_count, to%cells)
    call copy_corners(from%last_uses, from%cell_count, to%last_uses)
    call copy_arrays(from%cell_data, from%cell_count, info%cell_data, to%cell_data)
    call copy_list(from%finalized, from%finalized_count, 1, to%finalized)
    call copy_ids(from%faces, 3, from%face_count, to%faces)
    call copy_list(from%face_labels, from%face_count, 0, to%face_labels)
    call copy_flags(from%locked_faces, from%face_count, to%locked_faces)
    call copy_ids(from%locked_edges, 2, from%locked_edge_count, to%locked_edges)
  end subroutine

  subroutine copy_points(from, count, type, to)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: count
    integer, intent(in) :: type
    real(c_double), allocatable, intent(out) :: to(:, :)
    real(c_float), pointer :: narrow(:, :)
    real(c_double), pointer :: wide(:, :)

    allocate (to(3, count))
    if (count == 0) return
    if (type == TETSTREAM_TYPE_FLOAT32) then
      call c_f_pointer(from, narrow, [3_c_int64_t, count])
      to = narrow
    else
      call c_f_pointer(from, wide, [3_c_int64_t, count])
      to = wide
    end if
  end subroutine

  subroutine copy_arrays(from, rows, columns, to)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: rows
    type(tetstream_column), intent(in) :: columns(:)
    type(tetstream_array), allocatable, intent(out) :: to(:)
    type(c_ptr), pointer :: places(:)
    integer :: i, failed

    failed = 0
    nullify (places)
    allocate (to(size(columns)))
    if (rows > 0 .and. size(columns) > 0) call c_f_pointer(from, places, [size(columns)])
    do i = 1, size(columns)
      to(i)%name = columns(i)%name
      call to(i)%empty(columns(i)%type, columns(i)%components)
      if (rows == 0) cycle
      call to(i)%add(0_c_int64_t, places(i), rows, failed)
      call to(i)%trim(rows)
    end do
  end subroutine

  subroutine copy_flags(from, count, to)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: count
    logical, allocatable, intent(out) :: to(:)
    integer(c_int8_t), pointer :: flags(:)

    if (.not. c_associated(from) .or. count == 0) return
    call c_f_pointer(from, flags, [count])
    to = flags /= 0
  end subroutine

  ! Numbers of points, from 0 in C.
  subroutine copy_ids(from, components, count, to)
    type(c_ptr), intent(in) :: from
    integer, intent(in) :: components
    integer(c_int64_t), intent(in) :: count
    integer(c_int64_t), allocatable, intent(out) :: to(:, :)
    integer(c_int64_t), pointer :: ids(:, :)

    allocate (to(components, count))
    if (count == 0) return
    call c_f_pointer(from, ids, [int(components, c_int64_t), count])
    to = ids + 1
  end subroutine

  subroutine copy_list(from, count, first, to)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: count
    integer, intent(in) :: first
    integer(c_int64_t), allocatable, intent(out) :: to(:)
    integer(c_int64_t), pointer :: values(:)

    allocate (to(count))
    if (count == 0) return
    call c_f_pointer(from, values, [count])
    to = values + first
  end subroutine

  ! One bit for each corner.
  subroutine copy_corners(from, count, to)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: count
    logical, allocatable, intent(out) :: to(:, :)
    integer(c_int8_t), pointer :: bits(:)
    integer :: corner

    if (.not. c_associated(from) .or. count == 0) return
    call c_f_pointer(from, bits, [count])
    allocate (to(4, count))
    do corner = 1, 4
      to(corner, :) = btest(bits, corner - 1)
    end do
  end subroutine

end module
