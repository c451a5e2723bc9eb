! What is handed over to C: descriptions and batches as C has them, in memory that lives as long as the
! library reads them. Points are numbered from 0 there.
module tetstream_handover
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_arrays
  use tetstream_streams
  use tetstream_failures
  use tetstream_figures, only: tetstream_label_name
  implicit none
  private

  ! A name as C has it, with room for one letter more than the library takes: it refuses that.
  type :: column_room
    character(kind=c_char) :: names(257)
  end type

  ! A tetstream_stream_info for C, and what it points to.
  type, public :: info_room
    type(tetstream_stream_info) :: info
    type(c_column), allocatable :: fields(:), cell_data(:)
    type(column_room), allocatable :: field_names(:), cell_data_names(:)
    type(c_label_name), allocatable :: label_names(:)
    character(kind=c_char), allocatable :: label_texts(:)  ! one after the other
  contains
    procedure :: fill => fill_info
  end type

  ! A tetstream_batch for C, and what it points to.
  type, public :: batch_room
    type(tetstream_batch) :: batch
    real(c_float), allocatable :: narrow_points(:, :)
    type(c_ptr), allocatable :: fields(:), cell_data(:)
    integer(c_int8_t), allocatable :: locked(:), last_uses(:), locked_faces(:)
  contains
    procedure :: fill => fill_batch
  end type

  public :: flags_of

contains

  ! ------------------------------------------------------------------------------- descriptions

  ! Lays out the room's description for C; refuses a box that is not of the length that C reads.
  subroutine fill_info(this, out, stat, errmsg)
    class(info_room), intent(inout), target :: this
    type(c_stream_info), intent(inout) :: out
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    out%position_type = this%info%position_type
    if (this%info%indexed) out%flags = ior(out%flags, TETSTREAM_STREAM_INDEXED)
    call fill_columns(this%info%fields, this%fields, this%field_names, out%fields, out%field_count)
    call fill_columns(this%info%cell_data, this%cell_data, this%cell_data_names, out%cell_data, &
                      out%cell_data_count)
    out%vertex_count = this%info%vertex_count
    out%cell_count = this%info%cell_count
    out%face_count = this%info%face_count
    out%front_width = this%info%front_width
    out%front_span = this%info%front_span
    out%front_cells = this%info%front_cells
    call fill_box(this%info, this%info%box_min, "box_min", out%box_min, stat, errmsg)
    call fill_box(this%info, this%info%box_max, "box_max", out%box_max, stat, errmsg)
    if (allocated(this%info%label_names)) call fill_label_names(this, this%info%label_names, out)
    if (allocated(this%info%time)) then
      out%flags = ior(out%flags, TETSTREAM_STREAM_TIMED)
      out%time = this%info%time
    end if
  end subroutine

  subroutine fill_box(info, bounds, name, place, stat, errmsg)
    type(tetstream_stream_info), intent(in) :: info
    real(c_double), allocatable, intent(in), target :: bounds(:)
    character(*), intent(in) :: name
    type(c_ptr), intent(inout) :: place
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    integer :: length

    if (stat < 0 .or. .not. allocated(bounds)) return
    length = 3
    if (allocated(info%fields)) length = 3 + sum(info%fields%components)
    call need_rows("the numbers of "//name, size(bounds, kind=c_int64_t), int(length, c_int64_t), stat, errmsg)
    if (stat >= 0) place = c_loc(bounds)
  end subroutine

  subroutine fill_columns(columns, made, names, place, count)
    type(tetstream_column), allocatable, intent(inout) :: columns(:)
    type(c_column), allocatable, intent(inout), target :: made(:)
    type(column_room), allocatable, intent(inout), target :: names(:)
    type(c_ptr), intent(inout) :: place
    integer(c_int32_t), intent(inout) :: count
    integer :: i, j

    if (.not. allocated(columns)) allocate (columns(0))
    count = size(columns)
    if (count == 0) return
    if (allocated(made)) deallocate (made, names)
    allocate (made(count), names(count))
    do i = 1, count
      names(i)%names = c_null_char
      do j = 1, min(len(columns(i)%name), 256)
        names(i)%names(j) = columns(i)%name(j:j)
      end do
      made(i)%name = c_loc(names(i)%names)
      made(i)%components = columns(i)%components
      made(i)%type = columns(i)%type
    end do
    place = c_loc(made)
  end subroutine

  subroutine fill_label_names(this, names, out)
    class(info_room), intent(inout), target :: this
    type(tetstream_label_name), intent(in) :: names(:)
    type(c_stream_info), intent(inout) :: out
    integer(c_int64_t) :: i, at

    out%label_name_count = size(names, kind=c_int64_t)
    if (out%label_name_count == 0) return
    if (allocated(this%label_names)) deallocate (this%label_names, this%label_texts)
    allocate (this%label_names(size(names)))
    at = 0
    do i = 1, size(names, kind=c_int64_t)
      at = at + room_of(names(i)%name) + room_of(names(i)%cell_array)
    end do
    allocate (this%label_texts(at))
    at = 1
    do i = 1, size(names, kind=c_int64_t)
      this%label_names(i)%label = names(i)%label
      call put_text(names(i)%name, this%label_texts, at, this%label_names(i)%name)
      if (room_of(names(i)%cell_array) > 1) &
        call put_text(names(i)%cell_array, this%label_texts, at, this%label_names(i)%cell_array)
    end do
    out%label_names = c_loc(this%label_names)
  end subroutine

  ! Letters of a name for C, with the null: one more than the library takes at most.
  pure integer function room_of(name)
    character(:), allocatable, intent(in) :: name

    room_of = 0
    if (allocated(name)) room_of = min(len(name), 256) + 1
  end function

  ! A name into a place of that many letters; one that is not allocated is NULL.
  subroutine put_text(name, texts, at, place)
    character(:), allocatable, intent(in) :: name
    character(kind=c_char), intent(inout), target :: texts(:)
    integer(c_int64_t), intent(inout) :: at
    type(c_ptr), intent(inout) :: place
    integer :: i, room

    room = room_of(name)
    if (room == 0) return
    do i = 1, room - 1
      texts(at + i - 1) = name(i:i)
    end do
    texts(at + room - 1) = c_null_char
    place = c_loc(texts(at))
    at = at + room
  end subroutine

  ! ------------------------------------------------------------------------------------ batches

  ! Checks the room's batch against what the stream announced, and makes C's of it. Its numbers of
  ! points are then from 0.
  subroutine fill_batch(this, info, out, stat, errmsg)
    class(batch_room), intent(inout), target :: this
    type(tetstream_stream_info), intent(in) :: info
    type(c_batch), intent(inout) :: out
    integer, intent(out) :: stat
    character(*), intent(inout) :: errmsg

    stat = TETSTREAM_OK
    associate (b => this%batch)
      call fill_points(this, info, out, stat, errmsg)
      call fill_ids("cells", b%cells, 4, out%cell_count, out%cells, stat, errmsg)
      call fill_ids("faces", b%faces, 3, out%face_count, out%faces, stat, errmsg)
      call fill_ids("locked_edges", b%locked_edges, 2, out%locked_edge_count, out%locked_edges, stat, errmsg)
      call fill_arrays("field", b%fields, info%fields, out%vertex_count, this%fields, out%fields, stat, errmsg)
      call fill_arrays("cell array", b%cell_data, info%cell_data, out%cell_count, this%cell_data, &
                       out%cell_data, stat, errmsg)
      call fill_flags("locked", b%locked, out%vertex_count, this%locked, out%locked, stat, errmsg)
      call fill_flags("locked_faces", b%locked_faces, out%face_count, this%locked_faces, out%locked_faces, &
                      stat, errmsg)
      call fill_last_uses(this, out, stat, errmsg)
      call fill_labels(b, out, stat, errmsg)
      if (stat < 0 .or. .not. allocated(b%finalized)) return
      b%finalized = b%finalized - 1
      out%finalized_count = size(b%finalized, kind=c_int64_t)
      if (out%finalized_count > 0) out%finalized = c_loc(b%finalized)
    end associate
  end subroutine

  subroutine refuse(sentence, stat, errmsg)
    character(*), intent(in) :: sentence
    integer, intent(out) :: stat
    character(*), intent(inout) :: errmsg

    stat = TETSTREAM_BAD_ARGUMENT
    errmsg = sentence
  end subroutine

  ! "WHAT has COUNT rows, WANTED are needed" is refused, unless it is so.
  subroutine need_rows(what, count, wanted, stat, errmsg)
    character(*), intent(in) :: what
    integer(c_int64_t), intent(in) :: count, wanted
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    character(100) :: words

    if (count == wanted) return
    write (words, "(a, i0, a, i0, a)") ": there are ", count, ", where ", wanted, " are needed"
    call refuse(what//trim(words), stat, errmsg)
  end subroutine

  subroutine fill_points(this, info, out, stat, errmsg)
    class(batch_room), intent(inout), target :: this
    type(tetstream_stream_info), intent(in) :: info
    type(c_batch), intent(inout) :: out
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    if (.not. allocated(this%batch%points)) return
    call need_rows("the rows of points", size(this%batch%points, 1, c_int64_t), 3_c_int64_t, stat, errmsg)
    out%vertex_count = size(this%batch%points, 2, c_int64_t)
    if (stat < 0 .or. out%vertex_count == 0) return
    if (info%position_type == TETSTREAM_TYPE_FLOAT32) then
      this%narrow_points = real(this%batch%points, c_float)
      out%positions = c_loc(this%narrow_points)
    else
      out%positions = c_loc(this%batch%points)
    end if
  end subroutine

  subroutine fill_ids(what, ids, components, count, place, stat, errmsg)
    character(*), intent(in) :: what
    integer(c_int64_t), allocatable, intent(inout), target :: ids(:, :)
    integer, intent(in) :: components
    integer(c_int64_t), intent(inout) :: count
    type(c_ptr), intent(inout) :: place
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    if (stat < 0 .or. .not. allocated(ids)) return
    call need_rows("the rows of "//what, size(ids, 1, c_int64_t), int(components, c_int64_t), stat, errmsg)
    count = size(ids, 2, c_int64_t)
    if (stat < 0 .or. count == 0) return
    ids = ids - 1
    place = c_loc(ids)
  end subroutine

  subroutine fill_arrays(what, arrays, columns, rows, pointers, place, stat, errmsg)
    character(*), intent(in) :: what
    type(tetstream_array), allocatable, intent(in), target :: arrays(:)
    type(tetstream_column), intent(in) :: columns(:)
    integer(c_int64_t), intent(in) :: rows
    type(c_ptr), allocatable, intent(inout), target :: pointers(:)
    type(c_ptr), intent(inout) :: place
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    integer :: i

    if (stat < 0 .or. rows == 0 .or. size(columns) == 0) return
    if (.not. allocated(arrays)) then
      call refuse(what//' "'//columns(1)%name//'" was announced and is not in the batch', stat, errmsg)
      return
    end if
    call need_rows(what//"s of a batch", size(arrays, kind=c_int64_t), size(columns, kind=c_int64_t), &
                   stat, errmsg)
    if (stat < 0) return
    if (allocated(pointers)) deallocate (pointers)
    allocate (pointers(size(columns)))
    do i = 1, size(columns)
      if (arrays(i)%type() /= columns(i)%type .or. arrays(i)%components() /= columns(i)%components) then
        call refuse(what//' "'//columns(i)%name//'" has not the type or the components that were '// &
                    "announced", stat, errmsg)
        return
      end if
      call need_rows(what//' "'//columns(i)%name//'"', arrays(i)%rows(), rows, stat, errmsg)
      pointers(i) = arrays(i)%location()
    end do
    place = c_loc(pointers)
  end subroutine

  ! Flags as C has them.
  pure function flags_of(values) result(flags)
    logical, intent(in) :: values(:)
    integer(c_int8_t) :: flags(size(values))

    flags = merge(1_c_int8_t, 0_c_int8_t, values)
  end function

  subroutine fill_flags(what, values, rows, flags, place, stat, errmsg)
    character(*), intent(in) :: what
    logical, allocatable, intent(in) :: values(:)
    integer(c_int64_t), intent(in) :: rows
    integer(c_int8_t), allocatable, intent(inout), target :: flags(:)
    type(c_ptr), intent(inout) :: place
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    if (stat < 0 .or. .not. allocated(values)) return
    call need_rows(what, size(values, kind=c_int64_t), rows, stat, errmsg)
    if (stat < 0 .or. rows == 0) return
    flags = flags_of(values)
    place = c_loc(flags)
  end subroutine

  subroutine fill_last_uses(this, out, stat, errmsg)
    class(batch_room), intent(inout), target :: this
    type(c_batch), intent(inout) :: out
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    integer :: corner

    if (stat < 0 .or. .not. allocated(this%batch%last_uses)) return
    call need_rows("the rows of last_uses", size(this%batch%last_uses, 1, c_int64_t), 4_c_int64_t, stat, errmsg)
    call need_rows("last_uses", size(this%batch%last_uses, 2, c_int64_t), out%cell_count, stat, errmsg)
    if (stat < 0 .or. out%cell_count == 0) return
    if (allocated(this%last_uses)) deallocate (this%last_uses)
    allocate (this%last_uses(out%cell_count), source=0_c_int8_t)
    do corner = 1, 4
      where (this%batch%last_uses(corner, :)) this%last_uses = ibset(this%last_uses, corner - 1)
    end do
    out%last_uses = c_loc(this%last_uses)
  end subroutine

  ! Faces without labels have the label 0.
  subroutine fill_labels(batch, out, stat, errmsg)
    type(tetstream_batch), intent(inout), target :: batch
    type(c_batch), intent(inout) :: out
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    if (stat < 0 .or. out%face_count == 0) return
    if (.not. allocated(batch%face_labels)) allocate (batch%face_labels(out%face_count), source=0_c_int64_t)
    call need_rows("face_labels", size(batch%face_labels, kind=c_int64_t), out%face_count, stat, errmsg)
    out%face_labels = c_loc(batch%face_labels)
  end subroutine

end module
