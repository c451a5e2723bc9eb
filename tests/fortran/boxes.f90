! A cube of n x n x n boxes, each in six cells from its lowest corner to its highest, and its volume.
module boxes
  use, intrinsic :: iso_fortran_env, only: int64, real64
  implicit none
  private
  public :: make_boxes, volume, wave

contains

  subroutine make_boxes(n, points, cells)
    integer, intent(in) :: n
    real(real64), allocatable, intent(out) :: points(:, :)
    integer(int64), allocatable, intent(out) :: cells(:, :)
    integer, parameter :: ways(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
    integer :: x, y, z, way, corner, steps(3), at, i

    allocate (points(3, (n + 1)**3), cells(4, 6*n**3))
    steps = [1, n + 1, (n + 1)**2]
    do i = 0, (n + 1)**3 - 1
      points(:, i + 1) = real([mod(i, n + 1), mod(i/(n + 1), n + 1), i/(n + 1)**2], real64)/n
    end do
    at = 0
    do z = 0, n - 1
      do y = 0, n - 1
        do x = 0, n - 1
          do way = 1, 6
            at = at + 1
            corner = 1 + x + (n + 1)*(y + (n + 1)*z)
            cells(1, at) = corner
            do i = 1, 3
              corner = corner + steps(ways(i, way))
              cells(i + 1, at) = corner
            end do
          end do
        end do
      end do
    end do
  end subroutine

  ! A smooth field on points.
  function wave(points)
    real(real64), intent(in) :: points(:, :)
    real(real64) :: wave(size(points, 2))

    wave = sin(6*points(1, :))*cos(4*points(2, :)) + points(3, :)**2
  end function

  ! The sum of the cells' volumes without signs.
  function volume(points, cells)
    real(real64), intent(in) :: points(:, :)
    integer(int64), intent(in) :: cells(:, :)
    real(real64) :: volume, edges(3, 3)
    integer(int64) :: i
    integer :: j

    volume = 0
    do i = 1, size(cells, 2)
      do j = 1, 3
        edges(:, j) = points(:, cells(j + 1, i)) - points(:, cells(1, i))
      end do
      volume = volume + abs(edges(1, 1)*(edges(2, 2)*edges(3, 3) - edges(3, 2)*edges(2, 3)) &
                            - edges(2, 1)*(edges(1, 2)*edges(3, 3) - edges(3, 2)*edges(1, 3)) &
                            + edges(3, 1)*(edges(1, 2)*edges(2, 3) - edges(2, 2)*edges(1, 3)))/6
    end do
  end function

end module
