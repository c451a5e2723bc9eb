! Texts to and from C, and how a status becomes stat and errmsg. Depends on tetstream_c alone.
module tetstream_failures
  use, intrinsic :: iso_c_binding
  use tetstream_c
  implicit none
  private
  public :: sentence_length
  public :: fail, finished, forwarded, refuse_copy, settle, terminated, text_of

  ! Sentences have paths in them. note: gfortran 12 loses the length of an optional argument that is
  ! allocatable and of deferred length, when it is handed on: so errmsg has the length of the caller's.
  integer, parameter :: sentence_length = 2048

  interface
    pure function c_strlen(text) bind(c, name="strlen")
      import
      type(c_ptr), value :: text
      integer(c_size_t) :: c_strlen
    end function
  end interface

contains

  ! A text of the library's, copied; a null pointer is the empty text.
  function text_of(pointer) result(text)
    type(c_ptr), intent(in) :: pointer
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer(c_size_t) :: i

    text = ""
    if (.not. c_associated(pointer)) return
    call c_f_pointer(pointer, letters, [c_strlen(pointer)])
    deallocate (text)
    allocate (character(size(letters)) :: text)
    do i = 1, size(letters, kind=c_size_t)
      text(i:i) = letters(i)
    end do
  end function

  ! A text for C, without the blanks that fill it up; not allocated, which is NULL to C, without one.
  subroutine terminated(text, copy)
    character(*), intent(in), optional :: text
    character(:, kind=c_char), allocatable, intent(out) :: copy

    if (present(text)) copy = trim(text)//c_null_char
  end subroutine

  ! A failure with its sentence, as Fortran's ALLOCATE tells one: without `stat` the program ends.
  subroutine fail(status, sentence, stat, errmsg)
    integer, intent(in) :: status
    character(*), intent(in) :: sentence
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (.not. present(stat)) error stop "tetstream: "//trim(sentence)
    stat = status
    if (present(errmsg)) errmsg = sentence
  end subroutine

  ! What a call came to; `message` is the handle's, and `cause` what a procedure of the caller's told
  ! when it stopped the call.
  subroutine settle(status, message, stat, errmsg, cause)
    integer(c_int32_t), intent(in) :: status
    type(c_ptr), intent(in) :: message
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(*), intent(in), optional :: cause
    character(:), allocatable :: sentence

    if (status >= 0) then
      if (present(stat)) stat = status
      return
    end if
    sentence = text_of(message)
    if (sentence == "") sentence = text_of(c_status_name(status))
    if (present(cause) .and. status == TETSTREAM_CALLBACK) then
      if (cause /= "") sentence = sentence//": "//trim(cause)
    end if
    call fail(status, sentence, stat, errmsg)
  end subroutine

  subroutine finished(stat)
    integer, intent(out), optional :: stat

    if (present(stat)) stat = TETSTREAM_OK
  end subroutine

  ! Hands on what a call inside came to; whether it failed.
  function forwarded(status, sentence, stat, errmsg) result(failed)
    integer, intent(in) :: status
    character(*), intent(in) :: sentence
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    logical :: failed

    failed = status < 0
    if (failed) then
      call fail(status, sentence, stat, errmsg)
    else if (present(stat)) then
      stat = status
    end if
  end function

  ! Two variables with one handle would destroy it twice.
  subroutine refuse_copy(what)
    character(*), intent(in) :: what

    error stop "tetstream: a "//what//" cannot be copied"
  end subroutine

end module
