! The one-call form: arrays in, a mesh out.
module arrays_cases
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use boxes
  use checks
  use tetstream
  implicit none

  integer, parameter :: n = 8

contains

  subroutine a_tenth_is_left_of_the_same_cube
    real(real64), allocatable, target :: points(:, :), field(:)
    integer(int64), allocatable :: cells(:, :)
    real(real64), allocatable :: values(:)
    type(tetstream_mesh) :: small
    type(tetstream_report) :: report

    call make_boxes(n, points, cells)
    field = wave(points)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, ratio=0.1_real64, &
                            report=report)
    call check_equal(report%cells_in, 6*n**3, "all cells came in")
    call check_equal(report%cells_out, size(small%cells, 2), "the report tells of the result")
    call check(size(small%cells, 2) <= 307 .and. size(small%cells, 2) >= 297, "a tenth of 3072 is left")
    call check_says(report%reached, "ratio", "the target is named")
    call check(abs(volume(small%points, small%cells) - 1) < 1e-3_real64, "the cube keeps its volume")
    call check(minval(small%cells) == 1 .and. maxval(small%cells) == size(small%points, 2), &
               "points are numbered from 1, and all are used")
    call small%fields(small%field("wave"))%get(values)
    call check_equal(size(values), size(small%points, 2), "each point has its value")
    call check(maxval(abs(values - wave(small%points))) < 0.5, "values stay near the wave")
    call check_equal(small%field("none"), 0, "there is no other field")
  end subroutine

  ! All four kinds of arrays take the same way, and types of fields survive.
  subroutine other_kinds_give_the_same
    real(real64), allocatable, target :: points(:, :)
    real(real32), allocatable, target :: vector(:, :), narrow_points(:, :)
    integer(int64), allocatable, target :: cells(:, :), material(:)
    integer(int32), allocatable, target :: narrow_cells(:, :), tags(:)
    type(tetstream_field) :: fields(2), cell_data(1)
    type(tetstream_mesh) :: a, b, c, d
    type(tetstream_options) :: options
    real(real64), allocatable :: wide(:, :)
    real(real32), allocatable :: flat(:)
    integer(int32), allocatable :: labels(:)
    integer :: i, stat
    character(200) :: errmsg

    call make_boxes(n, points, cells)
    narrow_points = real(points, real32)
    narrow_cells = int(cells, int32)
    vector = real(2*points - 1, real32)
    tags = [(mod(i, 7), i=1, size(points, 2))]
    material = [(merge(1_int64, 2_int64, points(1, cells(1, i)) < 0.5), i=1, size(cells, 2))]
    fields = [tetstream_field("v", vector), tetstream_field("tag", tags)]
    cell_data = [tetstream_field("material", material)]
    call options%set("ratio", 0.3)
    call options%set("regions", "material")
    call tetstream_simplify(points, cells, fields, a, options, cell_data=cell_data)
    call tetstream_simplify(points, narrow_cells, fields, b, options, cell_data=cell_data)
    call tetstream_simplify(narrow_points, cells, fields, c, options, cell_data=cell_data)
    call tetstream_simplify(narrow_points, narrow_cells, fields, d, options, cell_data=cell_data)
    call check(same(a, b), "cells of int32")
    call check(same(c, d), "points of real32, cells of int32")
    call check(abs(volume(c%points, c%cells) - 1) < 1e-5_real64, "points of real32")
    call check_equal(a%fields(1)%type(), TETSTREAM_TYPE_FLOAT32, "the vector is real32 still")
    call check_equal(a%fields(1)%components(), 3, "and has three components")
    call check_equal(a%fields(2)%type(), TETSTREAM_TYPE_INT32, "tags are int32 still")
    call check_equal(a%cell_data(a%cell_array("material"))%type(), TETSTREAM_TYPE_INT64, "materials int64")

    call a%fields(1)%get(wide)
    call check(maxval(abs(wide - (2*a%points - 1))) < 1e-3, "values of real32 are given to real64")
    call a%cell_data(1)%get(labels)
    call check(minval(labels) == 1 .and. maxval(labels) == 2, "int64 is given to int32, where it fits")
    call a%fields(1)%get(flat, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "three components do not fit one dimension")
    call check_says(errmsg, '"v": it has 3 components', "and it says so")
    call a%fields(1)%get(labels, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "reals do not fit integers")
    deallocate (a%cell_data(1)%int64)
    allocate (a%cell_data(1)%int64(1, 1), source=2_int64**40)
    call a%cell_data(1)%get(labels, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "2**40 does not fit int32")
  end subroutine

  logical function same(a, b)
    type(tetstream_mesh), intent(in) :: a, b

    same = all(shape(a%points) == shape(b%points)) .and. all(shape(a%cells) == shape(b%cells))
    if (same) same = all(a%points == b%points) .and. all(a%cells == b%cells) .and. &
      all(a%fields(1)%float32 == b%fields(1)%float32) .and. all(a%cell_data(1)%int64 == b%cell_data(1)%int64)
  end function

  ! Labelled faces, and what is locked, count from 1, too.
  subroutine faces_and_locks_are_kept
    real(real64), allocatable, target :: points(:, :), field(:)
    integer(int64), allocatable, target :: cells(:, :)
    type(tetstream_mesh) :: marks, small, again
    type(tetstream_options) :: options
    integer :: i, j, found
    integer(int64) :: corners(3)

    call make_boxes(n, points, cells)
    field = wave(points)
    allocate (marks%faces(3, 0), marks%face_labels(0))
    do i = 1, size(cells, 2)
      do j = 1, 4
        corners = pack(cells(:, i), [1, 2, 3, 4] /= j)
        if (any(points(3, corners) > 0)) cycle
        marks%faces = reshape([marks%faces, corners], [3, size(marks%faces, 2) + 1])
        marks%face_labels = [marks%face_labels, 70_int64]
      end do
    end do
    call check_equal(size(marks%faces, 2), 2*n**2, "the floor has two faces a box")
    allocate (marks%locked(size(points, 2)), source=.false.)
    marks%locked(points_at([0.5_real64, 0.5_real64, 0.5_real64])) = .true.
    marks%locked_edges = reshape([1_int64, 2_int64], [2, 1])
    allocate (marks%locked_faces(size(marks%faces, 2)), source=.false.)
    marks%locked_faces(3) = .true.
    call options%set(TETSTREAM_OPTION_RATIO, 0.1_real64)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, options, marks=marks)
    call check(all(small%face_labels == 70) .and. size(small%face_labels) > 0, "labels are kept")
    call check(all(abs(small%points(3, [small%faces])) < 1e-3), "labelled faces are on the floor")
    call check(has([0.5_real64, 0.5_real64, 0.5_real64]), "the locked point is there")
    call check(has(points(:, 1)) .and. has(points(:, 2)), "so are the ends of the locked edge")
    call check(all([(has(points(:, marks%faces(i, 3))), i=1, 3)]), "and the locked face's corners")
    found = count(small%locked)
    call check(found >= 4, "locked points come out as such")

    call tetstream_simplify(small, again, ratio=1._real64)
    call check(all(again%face_labels == 70) .and. size(again%faces) == size(small%faces), "a mesh goes in as it came")
    call check_equal(count(again%locked), found, "with its locks")
  contains
    integer function points_at(place)
      real(real64), intent(in) :: place(3)
      points_at = findloc([(all(points(:, j) == place), j=1, size(points, 2))], .true., 1)
    end function
    logical function has(place)
      real(real64), intent(in) :: place(3)
      integer :: k
      has = any([(all(small%points(:, k) == place), k=1, size(small%points, 2))])
    end function
  end subroutine

  subroutine a_map_carries_values_back
    real(real64), allocatable, target :: points(:, :), field(:)
    integer(int64), allocatable :: cells(:, :)
    type(tetstream_mesh) :: small
    type(tetstream_map) :: map
    real(real64) :: place(3)
    integer :: i, outside

    call make_boxes(n, points, cells)
    field = wave(points)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, ratio=0.2_real64, map=map)
    call check_equal(size(map%cells), size(points, 2), "every point has a row")
    call check(minval(map%cells) >= 1 .and. maxval(map%cells) <= size(small%cells, 2), "and a cell, from 1")
    call check(maxval(abs(sum(map%weights, 1) - 1)) < 1e-12, "weights sum to 1")
    outside = 0
    do i = 1, size(points, 2)
      place = matmul(small%points(:, small%cells(:, map%cells(i))), map%weights(:, i))
      if (maxval(abs(place - points(:, i))) > 1e-9) outside = outside + 1
    end do
    call check_equal(outside, 0, "positions are linear: they come back")
  end subroutine

  subroutine what_is_wrong_is_told
    real(real64), allocatable, target :: points(:, :), field(:), short(:)
    integer(int64), allocatable, target :: cells(:, :)
    type(tetstream_mesh) :: small, marks, empty
    type(tetstream_options) :: options
    integer :: stat
    character(200) :: errmsg
    character(10) :: cut_off

    call make_boxes(2, points, cells)
    field = wave(points)
    short = field(:5)
    cells(2, 3) = 0
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_DATA, "0 is no point")
    call check_says(errmsg, "cell 3: vertex 0 is not one of the mesh's 27", "cells are counted from 1")
    cells(2, 3) = 28
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, stat=stat, errmsg=cut_off)
    call check_equal(stat, TETSTREAM_BAD_DATA, "nor is 28")
    call check(len_trim(cut_off) == 10, "a short variable takes what it holds")
    cells(2, 3) = 2
    call tetstream_simplify(points, cells, [tetstream_field("wave", short)], small, stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "fields are as long as points")
    call check_says(errmsg, '"wave": the last extent is 5, not 27', "and named")
    call tetstream_simplify(points(:2, :), cells, [tetstream_field("wave", field)], small, stat=stat, errmsg=errmsg)
    call check_says(errmsg, "points: the first extent is 2, not 3", "points have three coordinates")
    call tetstream_simplify(points, cells(:3, :), [tetstream_field("wave", field)], small, stat=stat, errmsg=errmsg)
    call check_says(errmsg, "cells: the first extent is 3, not 4", "cells have four corners")
    marks%faces = reshape([1_int64, 2_int64, 99_int64], [3, 1])
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, marks=marks, stat=stat, &
                            errmsg=errmsg)
    call check_says(errmsg, "labelled face 1: vertex 99", "faces are counted from 1")
    allocate (marks%face_labels(2), source=1_int64)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, marks=marks, stat=stat, &
                            errmsg=errmsg)
    call check_says(errmsg, "face_labels: the extent is 2, not 1", "each face has one label")
    deallocate (marks%faces)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, marks=marks, stat=stat, &
                            errmsg=errmsg)
    call check_says(errmsg, "face_labels: the extent is 2, not 0", "labels are of faces")
    call options%set("cells", 10)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, options, 0.1_real64, &
                            stat=stat, errmsg=errmsg)
    call check_says(errmsg, "options or a ratio, not both", "one of both")
    call tetstream_simplify(empty, small, stat=stat, errmsg=errmsg)
    call check_says(errmsg, "a mesh needs points and cells", "a mesh that is empty")
    call tetstream_simplify(points, cells, [tetstream_field(repeat("n", 300), field)], small, stat=stat, &
                            errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a name of 300 letters")
    call tetstream_simplify(points, cells, [tetstream_field(repeat("n", 255), field)], small, stat=stat)
    call check_equal(len(small%fields(1)%name), 255, "but 255 letters are a name")
    call options%set("cells", 47)
    call tetstream_simplify(points, cells, [tetstream_field("wave", field)], small, options, stat=stat, errmsg=errmsg)
    call check(stat >= 0, "the module goes on after failures")
  end subroutine

end module

program arrays_test
  use arrays_cases
  implicit none

  call a_tenth_is_left_of_the_same_cube
  call other_kinds_give_the_same
  call faces_and_locks_are_kept
  call a_map_carries_values_back
  call what_is_wrong_is_told
  call check_end
end program
