! Progress: a procedure of the caller's, told how far a run is.
module tetstream_listening
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_figures
  implicit none
  private
  public :: callback_of, user_of

  abstract interface
    ! Called some times a second; `cancel` set to .true. ends the run.
    subroutine tetstream_listen(progress, cancel)
      import :: tetstream_progress
      type(tetstream_progress), intent(in) :: progress
      logical, intent(inout) :: cancel
    end subroutine
  end interface
  public :: tetstream_listen

  type, public :: listener
    procedure(tetstream_listen), pointer, nopass :: told => null()
  end type

contains

  function tell(user, progress) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_progress), intent(in) :: progress
    integer(c_int32_t) :: stopped
    type(listener), pointer :: listens
    type(tetstream_progress) :: copy
    logical :: cancel

    call c_f_pointer(user, listens)
    call take(progress, copy)
    cancel = .false.
    call listens%told(copy, cancel)
    stopped = merge(1_c_int32_t, 0_c_int32_t, cancel)
  end function

  ! What C calls, and with what; null pointers where nobody listens.
  function callback_of(listens) result(callback)
    type(listener), intent(in) :: listens
    type(c_funptr) :: callback

    callback = c_null_funptr
    if (associated(listens%told)) callback = c_funloc(tell)
  end function

  function user_of(listens) result(user)
    type(listener), intent(in), target :: listens
    type(c_ptr) :: user

    user = c_loc(listens)
  end function

end module
