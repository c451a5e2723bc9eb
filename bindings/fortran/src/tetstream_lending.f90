! A mesh in arrays of the caller's, lent to C: nothing that is large is copied.
module tetstream_lending
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_arrays
  use tetstream_streams
  use tetstream_handover
  implicit none
  private

  ! What C's structs point to, beside the arrays themselves.
  type, public :: lent_room
    type(info_room) :: description
    type(c_ptr), allocatable :: fields(:), cell_data(:)
    integer(c_int8_t), allocatable :: locked(:), locked_faces(:)
    integer(c_int64_t), allocatable :: faces(:, :), face_labels(:), locked_edges(:, :)
  contains
    procedure :: fill => fill_lent
  end type

contains

  subroutine fill_lent(this, points, cells, fields, cell_data, marks, info, batch, status, refusal)
    class(lent_room), intent(inout), target :: this
    type(tetstream_field), intent(in) :: points, cells
    type(tetstream_field), intent(in), optional :: fields(:), cell_data(:)
    class(tetstream_mesh), intent(in), optional :: marks
    type(c_stream_info), intent(inout) :: info
    type(c_batch), intent(inout) :: batch
    integer, intent(inout) :: status
    character(*), intent(inout) :: refusal

    info%struct_size = c_sizeof(info)
    batch%struct_size = c_sizeof(batch)
    call need("points: the first extent", int(points%components, c_int64_t), 3_c_int64_t, status, refusal)
    call need("cells: the first extent", int(cells%components, c_int64_t), 4_c_int64_t, status, refusal)
    batch%vertex_count = points%rows
    batch%positions = points%values
    batch%cell_count = cells%rows
    if (cells%type == TETSTREAM_TYPE_INT32) then
      batch%cells32 = cells%values
    else
      batch%cells = cells%values
    end if
    this%description%info%position_type = points%type
    this%description%info%indexed = .true.
    if (present(fields)) &
      call lend(fields, points%rows, this%description%info%fields, this%fields, batch%fields, status, refusal)
    if (present(cell_data)) &
      call lend(cell_data, cells%rows, this%description%info%cell_data, this%cell_data, batch%cell_data, &
                status, refusal)
    if (present(marks)) call mark(this, marks, batch, status, refusal)
    call this%description%fill(info, status, refusal)
    info%flags = ior(info%flags, TETSTREAM_STREAM_FROM_ONE)
  end subroutine

  ! "WHAT is COUNT, not WANTED", unless it is so.
  subroutine need(what, count, wanted, status, refusal)
    character(*), intent(in) :: what
    integer(c_int64_t), intent(in) :: count, wanted
    integer, intent(inout) :: status
    character(*), intent(inout) :: refusal
    character(60) :: words

    if (count == wanted .or. status < 0) return
    write (words, "(a, i0, a, i0)") " is ", count, ", not ", wanted
    status = TETSTREAM_BAD_ARGUMENT
    refusal = what//trim(words)
  end subroutine

  subroutine lend(fields, rows, columns, pointers, place, status, refusal)
    type(tetstream_field), intent(in) :: fields(:)
    integer(c_int64_t), intent(in) :: rows
    type(tetstream_column), allocatable, intent(inout) :: columns(:)
    type(c_ptr), allocatable, intent(inout), target :: pointers(:)
    type(c_ptr), intent(inout) :: place
    integer, intent(inout) :: status
    character(*), intent(inout) :: refusal
    integer :: i

    if (size(fields) == 0) return
    allocate (columns(size(fields)))
    do i = 1, size(fields)
      columns(i)%name = trim(fields(i)%name)
      columns(i)%components = fields(i)%components
      columns(i)%type = fields(i)%type
      call need('"'//trim(fields(i)%name)//'": the last extent', fields(i)%rows, rows, status, refusal)
    end do
    pointers = fields%values
    place = c_loc(pointers)
  end subroutine

  subroutine mark(this, marks, batch, status, refusal)
    class(lent_room), intent(inout), target :: this
    class(tetstream_mesh), intent(in) :: marks
    type(c_batch), intent(inout) :: batch
    integer, intent(inout) :: status
    character(*), intent(inout) :: refusal

    if (allocated(marks%locked)) then
      call need("locked: the extent", size(marks%locked, kind=c_int64_t), batch%vertex_count, status, refusal)
      this%locked = flags_of(marks%locked)
      if (size(this%locked) > 0) batch%locked = c_loc(this%locked)
    end if
    call mark_faces(this, marks, batch, status, refusal)
    if (allocated(marks%label_names)) this%description%info%label_names = marks%label_names
    if (allocated(marks%time)) this%description%info%time = marks%time
    if (.not. allocated(marks%locked_edges)) return
    if (size(marks%locked_edges, 2) == 0) return
    call need("locked_edges: the first extent", size(marks%locked_edges, 1, c_int64_t), 2_c_int64_t, &
              status, refusal)
    this%locked_edges = marks%locked_edges
    batch%locked_edge_count = size(marks%locked_edges, 2, c_int64_t)
    batch%locked_edges = c_loc(this%locked_edges)
  end subroutine

  subroutine mark_faces(this, marks, batch, status, refusal)
    class(lent_room), intent(inout), target :: this
    class(tetstream_mesh), intent(in) :: marks
    type(c_batch), intent(inout) :: batch
    integer, intent(inout) :: status
    character(*), intent(inout) :: refusal

    if (allocated(marks%faces)) batch%face_count = size(marks%faces, 2, c_int64_t)
    if (batch%face_count > 0) then
      call need("faces: the first extent", size(marks%faces, 1, c_int64_t), 3_c_int64_t, status, refusal)
      this%faces = marks%faces
      batch%faces = c_loc(this%faces)
    end if
    if (allocated(marks%face_labels)) then
      this%face_labels = marks%face_labels
    else
      allocate (this%face_labels(batch%face_count), source=0_c_int64_t)
    end if
    call need("face_labels: the extent", size(this%face_labels, kind=c_int64_t), batch%face_count, &
              status, refusal)
    if (size(this%face_labels) > 0) batch%face_labels = c_loc(this%face_labels)
    if (.not. allocated(marks%locked_faces)) return
    call need("locked_faces: the extent", size(marks%locked_faces, kind=c_int64_t), batch%face_count, &
              status, refusal)
    this%locked_faces = flags_of(marks%locked_faces)
    if (size(this%locked_faces) > 0) batch%locked_faces = c_loc(this%locked_faces)
  end subroutine

end module
