! Names of labels, of faces and of cell arrays, wherever a mesh comes from and goes to.
module labels_cases
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use boxes
  use checks
  use sinks
  use tetstream
  implicit none

  integer, parameter :: n = 4

  ! One indexed batch, of a mesh whose names are announced.
  type, extends(tetstream_source) :: named_source
    type(tetstream_mesh) :: mesh
    logical :: given = .false.
  contains
    procedure :: open => named_open
    procedure :: next => named_next
  end type

contains

  subroutine named_open(this, info, stat, errmsg)
    class(named_source), intent(inout) :: this
    type(tetstream_stream_info), intent(inout) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (stays => stat, stays_too => errmsg)
    end associate
    info%indexed = .true.
    call info%add_cell_data("part", type=TETSTREAM_TYPE_INT32)
    info%label_names = this%mesh%label_names
  end subroutine

  subroutine named_next(this, batch, stat, errmsg)
    class(named_source), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (stays => stat, stays_too => errmsg)
    end associate
    if (this%given) return
    this%given = .true.
    batch%points = this%mesh%points
    batch%cells = this%mesh%cells
    batch%cell_data = this%mesh%cell_data
  end subroutine

  ! A box of two parts, whose floor is labelled 7.
  subroutine make_named(mesh)
    type(tetstream_mesh), intent(out) :: mesh
    integer(int64) :: corners(3)
    integer :: i, j

    call make_boxes(n, mesh%points, mesh%cells)
    allocate (mesh%cell_data(1), mesh%faces(3, 0), mesh%face_labels(0))
    mesh%cell_data(1)%name = "part"
    call mesh%cell_data(1)%set(merge(1, 2, mesh%points(1, mesh%cells(1, :)) < 0.5))
    do i = 1, size(mesh%cells, 2)
      do j = 1, 4
        corners = pack(mesh%cells(:, i), [1, 2, 3, 4] /= j)
        if (any(mesh%points(3, corners) > 0)) cycle
        mesh%faces = reshape([mesh%faces, corners], [3, size(mesh%faces, 2) + 1])
        mesh%face_labels = [mesh%face_labels, 7_int64]
      end do
    end do
    call mesh%add_label_name(2, "oil", "part")
    call mesh%add_label_name(7_int64, "inlet")
    call mesh%add_label_name(1, "steel", "part")
  end subroutine

  ! Names come sorted: those of faces, then those of arrays, by label.
  subroutine check_names(names, what)
    type(tetstream_label_name), allocatable, intent(in) :: names(:)
    character(*), intent(in) :: what

    call check(allocated(names), what//": there are names")
    if (.not. allocated(names)) return
    call check_equal(size(names), 3, what//": three names")
    if (size(names) /= 3) return
    call check(names(1)%name == "inlet" .and. names(1)%cell_array == "" .and. names(1)%label == 7, &
               what//": of the faces")
    call check(names(2)%name == "steel" .and. names(2)%cell_array == "part" .and. names(2)%label == 1, &
               what//": of the first part")
    call check(names(3)%name == "oil" .and. names(3)%cell_array == "part" .and. names(3)%label == 2, &
               what//": of the second part")
  end subroutine

  subroutine names_go_from_file_to_file
    type(tetstream_mesh), target :: mesh, small
    type(tetstream_mesh) :: again
    type(tetstream_reader) :: reader
    type(tetstream_stream_info) :: info

    call make_named(mesh)
    call tetstream_write("first.msh", mesh)
    call tetstream_read("first.msh", mesh, info=info)
    call check_names(mesh%label_names, "a mesh from a file")
    call check_names(info%label_names, "and what is told of it")
    call tetstream_simplify(mesh, small, ratio=0.5_real64)
    call check(size(small%cells, 2) < size(mesh%cells, 2), "it becomes smaller")
    call check_names(small%label_names, "a simplified mesh")
    call tetstream_write("second.msh", small)
    call tetstream_simplify_file("second.msh", "third.tets", ratio=0.9_real64)
    call reader%open_file("third.tets")
    call reader%get_info(info)
    call check_names(info%label_names, "a file of a file")
    call tetstream_inspect(reader, info)
    call check_names(info%label_names, "which was read")
    call tetstream_write("fourth.vtu", small)
    call tetstream_read("fourth.vtu", again, info=info)
    call check(.not. allocated(again%label_names), "a format without names")
    call check_equal(size(info%label_names), 0, "has none")
  end subroutine

  subroutine names_come_with_arrays
    type(tetstream_mesh), target :: mesh
    type(tetstream_mesh) :: small
    integer(int32), allocatable, target :: part(:)
    type(tetstream_field) :: no_fields(0)

    call make_named(mesh)
    call mesh%cell_data(1)%get(part)
    call tetstream_simplify(mesh%points, mesh%cells, no_fields, small, ratio=0.5_real64, &
                            cell_data=[tetstream_field("part", part)], marks=mesh)
    call check_names(small%label_names, "arrays")
  end subroutine

  subroutine names_come_with_streams
    type(named_source), target :: source
    type(listening_sink), target :: sink
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer

    call make_named(source%mesh)
    call reader%create(source)
    call writer%create(sink)
    call tetstream_convert(reader, writer)
    call check_names(sink%info%label_names, "a source to a sink")
  end subroutine

  subroutine names_are_pushed
    type(listening_sink), target :: sink
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_stream_info) :: info

    call writer%create(sink)
    call simplifier%create(writer)
    call info%add_cell_data("part", type=TETSTREAM_TYPE_INT32)
    call info%add_label_name(7, "inlet")
    call info%add_label_name(1_int64, "steel", "part")
    call info%add_label_name(2_int64, "oil  ", "part ")
    call simplifier%begin(info)
    call simplifier%finish()
    call check_names(sink%info%label_names, "pushed")
  end subroutine

  ! What comes of a name.
  subroutine run(label, name, cell_array, stat, errmsg)
    integer(int64), intent(in) :: label
    character(*), intent(in) :: name, cell_array
    integer, intent(out) :: stat
    character(*), intent(inout) :: errmsg
    type(tetstream_mesh), target :: mesh
    type(tetstream_reader) :: reader

    call make_named(mesh)
    call mesh%add_label_name(label, name, cell_array)
    call reader%open_mesh(mesh, stat, errmsg)
  end subroutine

  subroutine what_is_wrong_is_told
    type(tetstream_mesh), target :: mesh
    type(tetstream_reader) :: reader
    integer :: stat
    character(400) :: errmsg

    call run(3_int64, "gas", "nowhere", stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a name of an array that is not there")
    call check_says(errmsg, 'label name "gas": there is no cell array "nowhere"', "is refused by name")
    call run(7_int64, "outlet", "", stat, errmsg)
    call check_says(errmsg, 'faces 7 has two names, "inlet" and "outlet"', "one name a label")
    call run(8_int64, " ", "", stat, errmsg)
    call check_says(errmsg, "the name of faces 8 has no bytes", "no blanks")
    call run(8_int64, repeat("n", 300), "", stat, errmsg)
    call check_says(errmsg, "the name of faces 8 has", "nor 300 letters")
    call run(8_int64, "gas", repeat("n", 300), stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "no array has such a name")
    call run(huge(0_int64), repeat("n", 255), "part", stat, errmsg)
    call check_equal(stat, TETSTREAM_OK, "255 letters are a name, of any label")
    call make_named(mesh)
    deallocate (mesh%label_names(2)%name, mesh%label_names(2)%cell_array)
    call reader%open_mesh(mesh, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a name that was never set")
    call check_says(errmsg, "name 1 of labels is NULL", "says so")
  end subroutine

end module

program labels_test
  use labels_cases
  implicit none

  call names_go_from_file_to_file
  call names_come_with_arrays
  call names_come_with_streams
  call names_are_pushed
  call what_is_wrong_is_told
  call check_end
end program
