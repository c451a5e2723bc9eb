! The time of values, wherever a mesh comes from and goes to.
module times_cases
  use, intrinsic :: iso_fortran_env, only: real64
  use, intrinsic :: ieee_arithmetic
  use boxes
  use checks
  use sinks
  use tetstream
  implicit none

  real(real64), parameter :: noon = 1e-3_real64

contains

  subroutine check_time(time, what)
    real(real64), allocatable, intent(in) :: time
    character(*), intent(in) :: what

    call check(allocated(time), what//": there is a time")
    if (allocated(time)) call check(time == noon, what//": it is that which was given")
  end subroutine

  subroutine it_goes_from_file_to_file
    type(tetstream_mesh), target :: mesh, small
    type(tetstream_reader) :: reader
    type(tetstream_stream_info) :: info

    call make_boxes(4, mesh%points, mesh%cells)
    mesh%time = noon
    call tetstream_write("first.vtu", mesh)
    call tetstream_read("first.vtu", mesh, info=info)
    call check_time(mesh%time, "a mesh from a file")
    call check_time(info%time, "and what is told of it")
    call tetstream_simplify(mesh, small, ratio=0.5_real64)
    call check(size(small%cells, 2) < size(mesh%cells, 2), "it becomes smaller")
    call check_time(small%time, "a simplified mesh")
    call tetstream_write("second.tets", small)
    call reader%open_file("second.tets")
    call tetstream_inspect(reader, info)
    call check_time(info%time, "a file of it")
    deallocate (mesh%time)
    call tetstream_write("third.tets", mesh)
    call tetstream_read("third.tets", small, info=info)
    call check(.not. allocated(small%time), "a mesh without a time")
    call check(.not. allocated(info%time), "has none")
  end subroutine

  subroutine it_comes_with_arrays
    type(tetstream_mesh), target :: mesh
    type(tetstream_mesh) :: small
    type(tetstream_field) :: no_fields(0)

    call make_boxes(4, mesh%points, mesh%cells)
    mesh%time = noon
    call tetstream_simplify(mesh%points, mesh%cells, no_fields, small, ratio=0.5_real64, marks=mesh)
    call check_time(small%time, "arrays")
  end subroutine

  subroutine it_is_pushed
    type(listening_sink), target :: sink
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_stream_info) :: info

    call writer%create(sink)
    call simplifier%create(writer)
    info%time = noon
    call simplifier%begin(info)
    call simplifier%finish()
    call check_time(sink%info%time, "pushed")
  end subroutine

  subroutine one_that_is_not_finite_is_refused
    type(tetstream_mesh), target :: mesh
    type(tetstream_reader) :: reader
    integer :: stat
    character(200) :: errmsg

    call make_boxes(4, mesh%points, mesh%cells)
    mesh%time = ieee_value(noon, ieee_quiet_nan)
    call reader%open_mesh(mesh, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "no number")
    call check_says(errmsg, "the time is not finite", "says so")
  end subroutine

end module

program times_test
  use times_cases
  implicit none

  call it_goes_from_file_to_file
  call it_comes_with_arrays
  call it_is_pushed
  call one_that_is_not_finite_is_refused
  call check_end
end program
