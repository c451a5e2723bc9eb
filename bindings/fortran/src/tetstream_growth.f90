! Arrays of rows that grow while a mesh comes in.
module tetstream_growth
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: grow, shorten

  ! Puts rows behind the first `count` of an array, whose extent is at least doubled if need be; `failed` is
  ! set, and nothing done, where there is no memory for that.
  interface grow
    module procedure grow_float32, grow_float64, grow_int32, grow_int64
  end interface
  interface shorten
    module procedure shorten_float32, shorten_float64, shorten_int32, shorten_int64
  end interface

contains

  pure function roomier(extent, needed)
    integer(c_int64_t), intent(in) :: extent, needed
    integer(c_int64_t) :: roomier

    roomier = max(needed, 2*extent, 1024_c_int64_t)
  end function

  subroutine grow_float32(array, count, more, failed)
    real(c_float), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    real(c_float), intent(in) :: more(:, :)
    real(c_float), allocatable :: larger(:, :)
    integer, intent(inout) :: failed
    integer(c_int64_t) :: needed
    integer :: status

    needed = count + size(more, 2, c_int64_t)
    if (needed > size(array, 2, c_int64_t)) then
      allocate (larger(size(more, 1), roomier(size(array, 2, c_int64_t), needed)), stat=status)
      if (status /= 0) then
        failed = status
        return
      end if
      larger(:, :count) = array(:, :count)
      call move_alloc(larger, array)
    end if
    array(:, count + 1:needed) = more
  end subroutine

  subroutine shorten_float32(array, count)
    real(c_float), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    if (size(array, 2, c_int64_t) > count) array = array(:, :count)
  end subroutine

  subroutine grow_float64(array, count, more, failed)
    real(c_double), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    real(c_double), intent(in) :: more(:, :)
    real(c_double), allocatable :: larger(:, :)
    integer, intent(inout) :: failed
    integer(c_int64_t) :: needed
    integer :: status

    needed = count + size(more, 2, c_int64_t)
    if (needed > size(array, 2, c_int64_t)) then
      allocate (larger(size(more, 1), roomier(size(array, 2, c_int64_t), needed)), stat=status)
      if (status /= 0) then
        failed = status
        return
      end if
      larger(:, :count) = array(:, :count)
      call move_alloc(larger, array)
    end if
    array(:, count + 1:needed) = more
  end subroutine

  subroutine shorten_float64(array, count)
    real(c_double), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    if (size(array, 2, c_int64_t) > count) array = array(:, :count)
  end subroutine

  subroutine grow_int32(array, count, more, failed)
    integer(c_int32_t), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    integer(c_int32_t), intent(in) :: more(:, :)
    integer(c_int32_t), allocatable :: larger(:, :)
    integer, intent(inout) :: failed
    integer(c_int64_t) :: needed
    integer :: status

    needed = count + size(more, 2, c_int64_t)
    if (needed > size(array, 2, c_int64_t)) then
      allocate (larger(size(more, 1), roomier(size(array, 2, c_int64_t), needed)), stat=status)
      if (status /= 0) then
        failed = status
        return
      end if
      larger(:, :count) = array(:, :count)
      call move_alloc(larger, array)
    end if
    array(:, count + 1:needed) = more
  end subroutine

  subroutine shorten_int32(array, count)
    integer(c_int32_t), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    if (size(array, 2, c_int64_t) > count) array = array(:, :count)
  end subroutine

  subroutine grow_int64(array, count, more, failed)
    integer(c_int64_t), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    integer(c_int64_t), intent(in) :: more(:, :)
    integer(c_int64_t), allocatable :: larger(:, :)
    integer, intent(inout) :: failed
    integer(c_int64_t) :: needed
    integer :: status

    needed = count + size(more, 2, c_int64_t)
    if (needed > size(array, 2, c_int64_t)) then
      allocate (larger(size(more, 1), roomier(size(array, 2, c_int64_t), needed)), stat=status)
      if (status /= 0) then
        failed = status
        return
      end if
      larger(:, :count) = array(:, :count)
      call move_alloc(larger, array)
    end if
    array(:, count + 1:needed) = more
  end subroutine

  subroutine shorten_int64(array, count)
    integer(c_int64_t), allocatable, intent(inout) :: array(:, :)
    integer(c_int64_t), intent(in) :: count
    if (size(array, 2, c_int64_t) > count) array = array(:, :count)
  end subroutine

end module
