! The solver tests/examples/heat.f90, run on a box, where the answer is known, and on a part with fillets and
! holes. Environment: HEAT, the program; TETSTREAM_SOURCE.
module heat_cases
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use boxes
  use checks
  use tetstream
  implicit none

  ! A line of what the solver tells.
  type :: state
    integer :: step = 0
    real(real64) :: time = 0, content = 0, amplitude = 0
    integer(int64) :: cells = 0
  end type

contains

  function variable(name) result(value)
    character(*), intent(in) :: name
    character(:), allocatable :: value
    integer :: length

    call get_environment_variable(name, length=length)
    allocate (character(length) :: value)
    call get_environment_variable(name, value)
  end function

  ! Runs the solver; its lines, and its exit code.
  subroutine solve(arguments, states, code)
    character(*), intent(in) :: arguments
    type(state), allocatable, intent(out) :: states(:)
    integer, intent(out) :: code
    type(state) :: next
    character(200) :: line
    integer :: file, status

    code = 0  ! gfortran 12 reads it
    call execute_command_line("'"//variable("HEAT")//"' "//arguments//" >table 2>words", exitstat=code)
    allocate (states(0))
    open (newunit=file, file="table", status="old", action="read")
    do
      read (file, "(a)", iostat=status) line
      if (status /= 0) exit
      if (line(1:1) == "#") cycle
      read (line, *) next%step, next%time, next%content, next%amplitude, next%cells
      states = [states, next]
    end do
    close (file)
  end subroutine

  ! What must hold on any mesh of so many cells.
  subroutine check_states(name, states, cells)
    character(*), intent(in) :: name
    type(state), intent(in) :: states(:)
    integer(int64), intent(in) :: cells
    type(tetstream_mesh) :: small
    real(real64), allocatable :: u(:)
    character(100) :: path
    integer :: i

    call check(maxval(abs(states%content/states(1)%content - 1)) < 1e-8_real64, name//": heat is neither made nor lost")
    do i = 1, size(states)
      write (path, "(2a, i3.3, a)") name, "-", states(i)%step, ".tets"
      call tetstream_read(path, small)
      call check_equal(size(small%cells, 2), states(i)%cells, trim(path)//": the cells that were told")
      call check(10*size(small%cells, 2) <= cells .and. 11*size(small%cells, 2) > cells, trim(path)//": a tenth")
      call small%fields(small%field("u"))%get(u)
      call check(abs(content(small, u)/states(i)%content - 1) < 0.01, trim(path)//": its heat, within 1 %")
    end do
  end subroutine

  ! The integral of a linear field: the mean of its corners times the volume, cell by cell.
  real(real64) function content(mesh, u)
    type(tetstream_mesh), intent(in) :: mesh
    real(real64), intent(in) :: u(:)
    integer(int64) :: i

    content = 0
    do i = 1, size(mesh%cells, 2)
      content = content + sum(u(mesh%cells(:, i)))/4*volume(mesh%points, mesh%cells(:, i:i))
    end do
  end function

  subroutine a_box_cools_as_it_must
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    type(tetstream_stream_info) :: info
    type(state), allocatable :: states(:), halves(:)
    real(real64), parameter :: rate = acos(-1._real64)**2
    integer :: code

    call reader%generate("fluid", 10000_int64)
    call writer%create_file("fluid.tets")
    call tetstream_convert(reader, writer)
    call reader%open_file("fluid.tets")
    call tetstream_inspect(reader, info)
    call solve("fluid.tets box 40 10", states, code)
    call check_equal(code, 0, "the solver succeeds")
    call check_equal(size(states), 5, "it tells of five states")
    call check_states("box", states, info%cell_count)
    ! The cosine is an eigenfunction on a box: a step divides it by 1 + pi^2 dt / L^2, time itself makes
    ! it exp(-pi^2 t / L^2).
    call check(all(abs(states%amplitude*(1 + 0.001_real64*rate)**states%step - 1) < 0.01), "the cosine, step by step")
    call check(all(abs(states%amplitude*exp(rate*states%time) - 1) < 0.02), "the cosine, as in nature")
    call solve("fluid.tets half 80 80 0.0005", halves, code)
    call check(abs(halves(2)%time - states(5)%time) < 1e-12, "half the step, twice as many")
    call check(abs(halves(2)%amplitude*exp(rate*halves(2)%time) - 1) < 0.01, "are closer to nature")
  end subroutine

  ! An indexed mesh, ordered on the way.
  subroutine a_part_keeps_its_heat
    type(tetstream_reader) :: reader
    type(tetstream_stream_info) :: info
    type(state), allocatable :: states(:)
    integer :: code

    call reader%open_file(variable("TETSTREAM_SOURCE")//"/tests/data/bracket/bracket.vtu")
    call reader%get_info(info)
    call solve("'"//variable("TETSTREAM_SOURCE")//"/tests/data/bracket/bracket.vtu' part 2 2", states, code)
    call check_equal(size(states), 2, "it tells of two states")
    call check_states("part", states, info%cell_count)
  end subroutine

  subroutine what_is_wrong_is_told
    type(state), allocatable :: states(:)
    integer :: code, file
    character(200) :: line
    character(20), parameter :: arguments(3) = [character(20) :: "none.vtu out", "fluid.tets out 1 0", &
                                                "fluid.tets no/out 0"]
    character(20), parameter :: words(3) = [character(20) :: "none.vtu: cannot", "usage: heat MESH OUT", &
                                            "no/out-000.tets"]
    integer :: i

    do i = 1, 3
      call solve(trim(arguments(i)), states, code)
      call check_equal(code, 1, trim(arguments(i))//" fails")
      open (newunit=file, file="words", status="old", action="read")
      read (file, "(a)") line
      close (file)
      call check_says(line, trim(words(i)), "and says why")
    end do
  end subroutine

end module

program heat_test
  use heat_cases
  implicit none

  call a_box_cools_as_it_must
  if (variable("TETSTREAM_SLOW") == "") call a_part_keeps_its_heat
  call what_is_wrong_is_told
  call check_end
end program
