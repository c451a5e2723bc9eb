! The shared problem in Fortran, as README.md states it: arrays into arrays, and pushed into a file.
program same_answer
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use tetstream
  implicit none
  integer, parameter :: boxes = 12, side = boxes + 1
  integer, parameter :: ways(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])

  call solve

contains

  subroutine make_mesh(points, pressure, velocity, cells, material)
    real(real64), intent(out) :: points(:, :), pressure(:)
    real(real32), intent(out) :: velocity(:, :)
    integer, intent(out) :: cells(:, :), material(:)
    integer :: x, y, z, i, j, box, steps(3)

    do i = 1, side**3
      x = mod(i - 1, side)
      y = mod((i - 1)/side, side)
      z = (i - 1)/side**2
      points(:, i) = [x, y, z]/4._real64
      pressure(i) = x*x*y - 3*z
      velocity(:, i) = real([y - z, x*z, x + y], real32)
    end do
    steps = [1, side, side**2]
    do i = 1, 6*boxes**3
      box = (i - 1)/6
      x = mod(box, boxes)
      cells(1, i) = 1 + x + side*(mod(box/boxes, boxes) + side*(box/boxes**2))
      do j = 1, 3
        cells(j + 1, i) = cells(j, i) + steps(ways(j, 1 + mod(i - 1, 6)))
      end do
      material(i) = merge(1, 2, x < boxes/2)
    end do
  end subroutine

  subroutine solve
    real(real64), target :: points(3, side**3), pressure(side**3)
    real(real32), target :: velocity(3, side**3)
    integer, target :: cells(4, 6*boxes**3), material(6*boxes**3)
    type(tetstream_options) :: options
    type(tetstream_mesh) :: small
    type(tetstream_report) :: report

    call make_mesh(points, pressure, velocity, cells, material)
    call options%set("ratio", 0.2_real64)
    call options%set("boundary-weight", "4")
    call options%set(TETSTREAM_OPTION_REGIONS, "material")
    call options%add_field("pressure", 1._real64)
    call options%add_field("velocity", 0.5_real64)
    call tetstream_simplify(points, cells, [tetstream_field("pressure", pressure), &
                                            tetstream_field("velocity", velocity)], &
                            small, options, cell_data=[tetstream_field("material", material)], report=report)
    print "(a, i0, 2a)", "Fortran: ", report%cells_out, " cells, ", report%reached
    call write_raw(small)
    call push(points, pressure, velocity, cells, material, options)
  end subroutine

  subroutine write_raw(small)
    type(tetstream_mesh), intent(in) :: small
    integer :: file

    open (newunit=file, file="fortran.raw", access="stream", form="unformatted", status="replace")
    write (file) small%points, small%fields(1)%float64, small%fields(2)%float32, small%cells - 1, &
      small%cell_data(1)%int32
    close (file)
  end subroutine

  ! The same mesh in batches of odd sizes, as an indexed one may bring them.
  subroutine push(points, pressure, velocity, cells, material, options)
    real(real64), intent(in) :: points(:, :), pressure(:)
    real(real32), intent(in) :: velocity(:, :)
    integer, intent(in) :: cells(:, :), material(:)
    type(tetstream_options), intent(in) :: options
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_stream_info) :: info
    type(tetstream_batch) :: batch
    integer :: first, last, begin, end

    call writer%create_file("fortran.tets")
    call simplifier%create(writer, options)
    info%indexed = .true.
    call info%add_field("pressure")
    call info%add_field("velocity", 3, TETSTREAM_TYPE_FLOAT32)
    call info%add_cell_data("material", type=TETSTREAM_TYPE_INT32)
    call simplifier%begin(info)
    allocate (batch%fields(2), batch%cell_data(1))
    last = 0
    end = 0
    do while (last < size(points, 2) .or. end < size(cells, 2))
      first = last + 1
      last = min(last + 97, size(points, 2))
      begin = end + 1
      end = min(end + 501, size(cells, 2))
      batch%points = points(:, first:last)
      call batch%fields(1)%set(pressure(first:last))
      call batch%fields(2)%set(velocity(:, first:last))
      batch%cells = cells(:, begin:end)
      call batch%cell_data(1)%set(material(begin:end))
      call simplifier%push(batch)
    end do
    call simplifier%finish()
  end subroutine

end program
