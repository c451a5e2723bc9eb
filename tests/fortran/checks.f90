! Checks for programs in Fortran: counts them, prints those that fail, goes on.
module checks
  implicit none
  private
  public :: check, check_equal, check_says, check_end

  integer :: count = 0, failures = 0

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(*), intent(in) :: what

    count = count + 1
    if (holds) return
    failures = failures + 1
    print "(2a)", "does not hold: ", what
  end subroutine

  subroutine check_equal(is, wanted, what)
    class(*), intent(in) :: is, wanted
    character(*), intent(in) :: what

    call check(number(is) == number(wanted), what)
    if (number(is) /= number(wanted)) print "(a, i0, a, i0)", "    is ", number(is), ", wanted ", number(wanted)
  end subroutine

  function number(value)
    use, intrinsic :: iso_fortran_env, only: int32, int64
    class(*), intent(in) :: value
    integer(int64) :: number

    number = -huge(number)
    select type (value)
    type is (integer(int32))
      number = value
    type is (integer(int64))
      number = value
    end select
  end function

  ! Whether `part` stands in `text`.
  subroutine check_says(text, part, what)
    character(*), intent(in) :: text, part, what

    call check(index(text, part) > 0, what)
    if (index(text, part) == 0) print "(5a)", '    is "', trim(text), '", wanted "', part, '" in it'
  end subroutine

  subroutine check_end()
    print "(i0, a, i0, a)", count, " checks, ", failures, " failed"
    if (failures > 0) error stop 1
  end subroutine

end module
