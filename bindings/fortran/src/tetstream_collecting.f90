! A sink and a map that end in arrays.
module tetstream_collecting
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_arrays
  use tetstream_growth
  use tetstream_streams
  use tetstream_tracing
  use tetstream_writers
  implicit none
  private

  ! Where the points of the input lie in the output.
  type, extends(tetstream_map_sink), public :: tetstream_map
    integer(c_int64_t), allocatable :: cells(:)     ! the cell of each point, from 1; 0: it is in no cell
    real(c_double), allocatable :: weights(:, :)    ! (4, n) of the cell's corners
  contains
    procedure :: put => map_put
  end type

  ! A mesh that comes in batches.
  type, extends(tetstream_sink), public :: collector
    type(tetstream_stream_info) :: info
    type(tetstream_mesh) :: mesh
    integer(c_int64_t) :: point_count = 0, cell_count = 0
  contains
    procedure :: open => collector_open
    procedure :: put => collector_put
    procedure :: finish => collector_finish
  end type

contains

  subroutine map_put(this, rows, stat, errmsg)
    class(tetstream_map), intent(inout) :: this
    type(tetstream_map_rows), intent(inout) :: rows
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    integer(c_int64_t) :: i

    do i = 1, size(rows%vertices, kind=c_int64_t)
      if (rows%vertices(i) > size(this%cells, kind=c_int64_t)) then
        stat = 1
        errmsg = "the map tells of a point that is not there"
        return
      end if
      this%cells(rows%vertices(i)) = rows%cells(i)
      this%weights(:, rows%vertices(i)) = rows%weights(:, i)
    end do
  end subroutine

  subroutine collector_open(this, info, stat, errmsg)
    class(collector), intent(inout) :: this
    type(tetstream_stream_info), intent(in) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (stays => stat, stays_too => errmsg)
    end associate
    this%info = info
    this%mesh = tetstream_mesh()
    this%point_count = 0
    this%cell_count = 0
    allocate (this%mesh%points(3, promised(info%vertex_count)))
    allocate (this%mesh%cells(4, promised(info%cell_count)))
    call begin(this%mesh%fields, info%fields)
    call begin(this%mesh%cell_data, info%cell_data)
    if (size(info%label_names) > 0) this%mesh%label_names = info%label_names
    if (allocated(info%time)) this%mesh%time = info%time
  end subroutine

  ! How many rows are taken on trust: the header of a broken file may tell of any number.
  pure function promised(count)
    integer(c_int64_t), intent(in) :: count
    integer(c_int64_t) :: promised

    promised = min(max(count, 0_c_int64_t), 2_c_int64_t**24)
  end function

  subroutine begin(arrays, columns)
    type(tetstream_array), allocatable, intent(inout) :: arrays(:)
    type(tetstream_column), intent(in) :: columns(:)
    integer :: i

    allocate (arrays(size(columns)))
    do i = 1, size(columns)
      arrays(i)%name = columns(i)%name
      call arrays(i)%empty(columns(i)%type, columns(i)%components)
    end do
  end subroutine

  subroutine collector_put(this, batch, stat, errmsg)
    class(collector), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    integer :: i

    call add_flags(this%mesh%locked, this%point_count, batch%locked, size(batch%points, 2, c_int64_t))
    call grow(this%mesh%points, this%point_count, batch%points, stat)
    call grow(this%mesh%cells, this%cell_count, batch%cells, stat)
    do i = 1, size(this%mesh%fields)
      call append(this%mesh%fields(i), this%point_count, batch%fields(i), stat)
    end do
    do i = 1, size(this%mesh%cell_data)
      call append(this%mesh%cell_data(i), this%cell_count, batch%cell_data(i), stat)
    end do
    this%point_count = this%point_count + size(batch%points, 2)
    this%cell_count = this%cell_count + size(batch%cells, 2)
    call add_marks(this%mesh, batch)
    if (stat /= 0) errmsg = "there is no memory for the result"
  end subroutine

  ! The rows of another array behind those that are there.
  subroutine append(array, count, more, stat)
    type(tetstream_array), intent(inout) :: array
    integer(c_int64_t), intent(in) :: count
    type(tetstream_array), intent(in), target :: more  ! whose place in memory is taken
    integer, intent(inout) :: stat

    call array%add(count, more%location(), more%rows(), stat)
  end subroutine

  ! Labelled faces and locked edges: few, beside the cells.
  subroutine add_marks(mesh, batch)
    type(tetstream_mesh), intent(inout) :: mesh
    type(tetstream_batch), intent(in) :: batch
    integer(c_int64_t) :: before, edges

    if (size(batch%faces) > 0) then
      if (.not. allocated(mesh%faces)) allocate (mesh%faces(3, 0), mesh%face_labels(0))
      before = size(mesh%faces, 2)
      call add_flags(mesh%locked_faces, before, batch%locked_faces, size(batch%faces, 2, c_int64_t))
      mesh%faces = reshape([mesh%faces, batch%faces], [3_c_int64_t, before + size(batch%faces, 2)])
      mesh%face_labels = [mesh%face_labels, batch%face_labels]
    end if
    if (size(batch%locked_edges) > 0) then
      if (.not. allocated(mesh%locked_edges)) allocate (mesh%locked_edges(2, 0))
      edges = size(mesh%locked_edges, 2) + size(batch%locked_edges, 2)
      mesh%locked_edges = reshape([mesh%locked_edges, batch%locked_edges], [2_c_int64_t, edges])
    end if
  end subroutine

  ! Flags are there from the first batch on that has one.
  subroutine add_flags(flags, before, more, count)
    logical, allocatable, intent(inout) :: flags(:)
    integer(c_int64_t), intent(in) :: before, count
    logical, allocatable, intent(in) :: more(:)

    if (.not. allocated(flags) .and. .not. allocated(more)) return
    if (.not. allocated(flags)) allocate (flags(before), source=.false.)
    if (allocated(more)) then
      flags = [flags, more]
    else
      flags = [flags, spread(.false., 1, int(count))]
    end if
  end subroutine

  subroutine collector_finish(this, stat, errmsg)
    class(collector), intent(inout) :: this
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    integer :: i

    associate (stays => stat, stays_too => errmsg)
    end associate
    call shorten(this%mesh%points, this%point_count)
    call shorten(this%mesh%cells, this%cell_count)
    do i = 1, size(this%mesh%fields)
      call this%mesh%fields(i)%trim(this%point_count)
    end do
    do i = 1, size(this%mesh%cell_data)
      call this%mesh%cell_data(i)%trim(this%cell_count)
    end do
  end subroutine

end module
