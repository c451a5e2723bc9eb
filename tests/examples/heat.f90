! In situ: a solver of the heat equation that hands its time steps to the simplifier while it runs.
!
!   heat MESH OUT [STEPS [EVERY [DT]]]
!   gfortran heat.f90 $(pkg-config --cflags --libs tetstream-fortran) -o heat
!
! Solves u_t = div(grad u) on the tetrahedra of MESH, a file in any format that tetstream reads: linear
! finite elements, no flux through the boundary, lumped mass, backward Euler, conjugate gradients. At
! first u = 1 + cos(pi s), s = (x - xmin) / L, where L = xmax - xmin. STEPS (50) steps of DT (0.001)
! times L * L are done; the first state and that after every EVERY-th step (10) are simplified to a tenth
! and written to OUT-000.tets, OUT-010.tets and so on.
!
! Of each of them a line tells the step, t / L^2, the heat content (sum of mass times u), the amplitude of
! the cosine (on a box it decays like exp(-pi^2 t / L^2)), and the cells that were written. No call asks
! for its status: what fails ends the program, with the library's sentence.
module heat_equation
  use, intrinsic :: iso_fortran_env, only: int64, real64
  use tetstream
  implicit none

  integer, parameter :: batch_cells = 8192                ! that are handed over at a time
  integer, parameter :: pairs(2, 6) = reshape([1, 2, 1, 3, 1, 4, 2, 3, 2, 4, 3, 4], [2, 6])

  ! The mesh in the order of a stream, and the equations on it.
  type :: heat
    type(tetstream_mesh) :: mesh
    type(tetstream_stream_info) :: info                   ! what is announced of each step
    logical, allocatable :: last_uses(:, :)               ! (4, cells): no later cell uses the corner
    real(real64), allocatable :: stiffness(:, :)          ! (6, cells), of the pairs of corners
    real(real64), allocatable :: mass(:), diagonal(:), cosine(:), u(:)
    real(real64) :: dt
  end type

contains

  ! Reads the mesh in an order that streams well: a file that is no stream is ordered on the way.
  subroutine read_mesh(h, path)
    type(heat), intent(inout) :: h
    character(*), intent(in) :: path
    type(tetstream_stream_info) :: info
    logical, allocatable :: seen(:)
    integer(int64) :: cell
    integer :: corner

    call tetstream_read(path, h%mesh, info=info)
    call h%info%add_field("u")
    h%info%vertex_count = size(h%mesh%points, 2)
    h%info%cell_count = size(h%mesh%cells, 2)
    h%info%front_cells = info%front_cells
    ! The stream ends a point with the last cell that uses it: seen from the end, the first.
    allocate (seen(size(h%mesh%points, 2)), source=.false.)
    allocate (h%last_uses(4, size(h%mesh%cells, 2)))
    do cell = size(h%mesh%cells, 2), 1, -1
      do corner = 1, 4
        h%last_uses(corner, cell) = .not. seen(h%mesh%cells(corner, cell))
        seen(h%mesh%cells(corner, cell)) = .true.
      end do
    end do
  end subroutine

  function cross(a, b)
    real(real64), intent(in) :: a(3), b(3)
    real(real64) :: cross(3)

    cross = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function

  ! Volume and stiffness of a cell: with the normal n_i, as long as twice the area, of the face across
  ! from corner i, integral grad_i . grad_j = n_i . n_j / (36 volume).
  subroutine add_cell(h, cell)
    type(heat), intent(inout) :: h
    integer(int64), intent(in) :: cell
    real(real64) :: edge(3, 2:4), normal(3, 4), volume
    integer :: i

    associate (corners => h%mesh%cells(:, cell))
      do i = 2, 4
        edge(:, i) = h%mesh%points(:, corners(i)) - h%mesh%points(:, corners(1))
      end do
      normal(:, 2) = cross(edge(:, 3), edge(:, 4))
      normal(:, 3) = cross(edge(:, 4), edge(:, 2))
      normal(:, 4) = cross(edge(:, 2), edge(:, 3))
      normal(:, 1) = -sum(normal(:, 2:4), 2)
      volume = abs(dot_product(edge(:, 2), normal(:, 2)))/6
      if (.not. volume > 0) error stop "heat: a cell is flat"
      do i = 1, 4
        h%mass(corners(i)) = h%mass(corners(i)) + volume/4
      end do
      do i = 1, 6
        h%stiffness(i, cell) = dot_product(normal(:, pairs(1, i)), normal(:, pairs(2, i)))/(36*volume)
        ! The rows of the stiffness sum to 0: what is on the diagonal is minus the rest.
        associate (ends => corners(pairs(:, i)))
          h%diagonal(ends) = h%diagonal(ends) - h%dt*h%stiffness(i, cell)
        end associate
      end do
    end associate
  end subroutine

  subroutine assemble(h, dt_over_square)
    type(heat), intent(inout) :: h
    real(real64), intent(in) :: dt_over_square
    real(real64), parameter :: pi = acos(-1._real64)
    real(real64) :: low, length
    integer(int64) :: cell

    associate (x => h%mesh%points(1, :))
      low = minval(x)
      length = maxval(x) - low
      h%dt = dt_over_square*length**2
      h%cosine = cos(pi*(x - low)/length)
    end associate
    h%u = 1 + h%cosine
    allocate (h%mass(size(h%u)), h%diagonal(size(h%u)), source=0._real64)
    allocate (h%stiffness(6, size(h%mesh%cells, 2)))
    do cell = 1, size(h%mesh%cells, 2)
      call add_cell(h, cell)
    end do
    h%diagonal = h%diagonal + h%mass
    where (h%mass == 0) h%diagonal = 1                    ! a point in no cell stays as it is
  end subroutine

  ! out = (mass + dt stiffness) in
  subroutine apply(h, in, out)
    type(heat), intent(in) :: h
    real(real64), intent(in) :: in(:)
    real(real64), intent(out) :: out(:)
    real(real64) :: flow
    integer(int64) :: cell, a, b
    integer :: i

    out = h%mass*in
    do cell = 1, size(h%mesh%cells, 2)
      do i = 1, 6
        a = h%mesh%cells(pairs(1, i), cell)
        b = h%mesh%cells(pairs(2, i), cell)
        flow = h%dt*h%stiffness(i, cell)*(in(b) - in(a))
        out(a) = out(a) + flow
        out(b) = out(b) - flow
      end do
    end do
  end subroutine

  ! One step: (mass + dt stiffness) u_new = mass u, down to 1e-10 of the right-hand side, by conjugate
  ! gradients that begin at u and divide by the diagonal.
  subroutine step(h)
    type(heat), intent(inout) :: h
    real(real64), dimension(size(h%u)) :: r, p, q
    real(real64) :: enough, before, after, length
    integer :: iteration

    call apply(h, h%u, q)
    enough = 1e-20_real64*sum((h%mass*h%u)**2)
    r = h%mass*h%u - q
    p = r/h%diagonal
    before = dot_product(r, p)
    do iteration = 1, 10000
      if (dot_product(r, r) <= enough) return
      call apply(h, p, q)
      length = before/dot_product(p, q)
      h%u = h%u + length*p
      r = r - length*q
      after = sum(r**2/h%diagonal)
      p = r/h%diagonal + after/before*p
      before = after
    end do
    error stop "heat: conjugate gradients: no convergence in 10000 iterations"
  end subroutine

  ! The mesh and its box once more, with the field as it is now, in pieces: each has the points that its
  ! cells are the first to use.
  subroutine push_mesh(h, time, simplifier)
    type(heat), intent(inout) :: h
    real(real64), intent(in) :: time
    type(tetstream_simplifier), intent(inout) :: simplifier
    type(tetstream_batch) :: batch
    integer(int64) :: first, last, point, top

    h%info%box_min = [minval(h%mesh%points, 2), minval(h%u)]
    h%info%box_max = [maxval(h%mesh%points, 2), maxval(h%u)]
    h%info%time = time
    call simplifier%begin(h%info)
    allocate (batch%fields(1))
    point = 0                                             ! the last one that was handed over
    do first = 1, size(h%mesh%cells, 2), batch_cells
      last = min(first + batch_cells - 1, size(h%mesh%cells, 2, int64))
      batch%cells = h%mesh%cells(:, first:last)
      batch%last_uses = h%last_uses(:, first:last)
      top = max(point, maxval(batch%cells))
      batch%points = h%mesh%points(:, point + 1:top)
      call batch%fields(1)%set(h%u(point + 1:top))
      point = top
      call simplifier%push(batch)
    end do
    call simplifier%finish()
  end subroutine

  subroutine write_step(h, out, number, time)
    type(heat), intent(inout) :: h
    character(*), intent(in) :: out
    integer, intent(in) :: number
    real(real64), intent(in) :: time
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_report) :: report
    real(real64), dimension(size(h%u)) :: wave            ! the cosine without its mean
    character(20) :: ending

    write (ending, "(a, i3.3, a)") "-", number, ".tets"
    call writer%create_file(out//trim(ending))
    call simplifier%create(writer)
    call push_mesh(h, number*h%dt, simplifier)
    call simplifier%get_report(report)
    wave = h%cosine - sum(h%mass*h%cosine)/sum(h%mass)
    print "(i0, 1x, es12.6, 1x, es21.15, 1x, es16.9, 1x, i0)", number, time, sum(h%mass*h%u), &
      sum(h%mass*wave*h%u)/sum(h%mass*wave**2), report%cells_out
  end subroutine

  subroutine run(path, out, steps, every, dt)
    character(*), intent(in) :: path, out
    integer, intent(in) :: steps, every
    real(real64), intent(in) :: dt
    type(heat) :: h
    integer :: done

    call read_mesh(h, path)
    call assemble(h, dt)
    print "(a)", "# step time content amplitude cells"
    do done = 0, steps
      if (done > 0) call step(h)
      if (mod(done, every) == 0) call write_step(h, out, done, done*dt)
    end do
  end subroutine

end module

program main
  use heat_equation
  implicit none
  character(1000) :: words(5) = [character(1000) :: "", "", "50", "10", "0.001"]
  integer :: i, steps, every, bad
  real(real64) :: dt

  do i = 1, min(command_argument_count(), 5)
    call get_command_argument(i, words(i))
  end do
  read (words(3:), *, iostat=bad) steps, every, dt
  if (bad /= 0 .or. command_argument_count() < 2 .or. command_argument_count() > 5) &
    error stop "usage: heat MESH OUT [STEPS [EVERY [DT]]]"
  if (steps < 0 .or. every < 1 .or. .not. dt > 0) error stop "usage: heat MESH OUT [STEPS [EVERY [DT]]]"
  call run(trim(words(1)), trim(words(2)), steps, every, dt)
end program
