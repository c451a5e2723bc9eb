! Options, by name or by number. The handle is made when the first one is set: until then, and for who
! sets none, all have their defaults.
module tetstream_settings
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures
  use tetstream_figures
  implicit none
  private
  public :: tetstream_option_count, tetstream_option_at, handle_of

  type, public :: tetstream_options
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, private :: set_name_int32, set_name_int64, set_name_float32, set_name_float64, set_name_text
    procedure, private :: set_id_int32, set_id_int64, set_id_float32, set_id_float64, set_id_text
    generic :: set => set_name_int32, set_name_int64, set_name_float32, set_name_float64, set_name_text, &
      set_id_int32, set_id_int64, set_id_float32, set_id_float64, set_id_text
    procedure, private :: get_name_int64, get_name_float64, get_name_text
    procedure, private :: get_id_int64, get_id_float64, get_id_text
    generic :: get => get_name_int64, get_name_float64, get_name_text, get_id_int64, get_id_float64, get_id_text
    procedure :: add_field => options_add_field
    procedure :: set_pool => options_set_pool
    procedure :: destroy => options_destroy
    procedure, private :: options_copy
    generic :: assignment(=) => options_copy
    final :: options_final
  end type

contains

  ! For C: a null pointer for none, which stands for the defaults.
  function handle_of(options) result(handle)
    type(tetstream_options), intent(in), optional :: options
    type(c_ptr) :: handle

    handle = c_null_ptr
    if (present(options)) handle = options%handle
  end function

  integer function tetstream_option_count()
    tetstream_option_count = c_option_count()
  end function

  ! Row `index` of the table of options, from 1.
  subroutine tetstream_option_at(index, info, stat, errmsg)
    integer, intent(in) :: index
    type(tetstream_option_info), intent(inout) :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_option_info) :: row
    integer(c_int32_t) :: status

    row%struct_size = c_sizeof(row)
    status = c_option_at(index - 1, row)
    if (status >= 0) call take(row, info)
    call settle(status, c_null_ptr, stat, errmsg)
  end subroutine

  ! The row of an option; 0 as its number: there is none of that name.
  subroutine find(name, row)
    character(*), intent(in) :: name
    type(tetstream_option_info), intent(inout) :: row
    integer :: i

    do i = 1, tetstream_option_count()
      call tetstream_option_at(i, row)
      if (row%name == name) return
    end do
    row%id = 0
  end subroutine

  integer function id_of(name)
    character(*), intent(in) :: name
    type(tetstream_option_info) :: row

    call find(name, row)
    id_of = row%id
  end function

  subroutine need_handle(this)
    class(tetstream_options), intent(inout) :: this
    integer(c_int32_t) :: status

    if (.not. c_associated(this%handle)) status = c_options_create(this%handle)
  end subroutine

  subroutine told(this, status, stat, errmsg)
    class(tetstream_options), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call settle(status, c_options_message(this%handle), stat, errmsg)
  end subroutine

  ! ------------------------------------------------------------------------------------ setting

  ! As on a command line: "64M", "1e6".
  subroutine set_name_text(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name, value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call need_handle(this)
    call told(this, c_options_parse(this%handle, trim(name)//c_null_char, trim(value)//c_null_char), stat, errmsg)
  end subroutine

  ! An integer for an option that is a real number is that number.
  subroutine set_name_int64(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    integer(c_int64_t), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(tetstream_option_info) :: row
    character(24) :: text

    call find(name, row)
    if (row%id == 0) then  ! the library has the sentence
      write (text, "(i0)") value
      call this%set(name, trim(text), stat, errmsg)
    else if (row%type == TETSTREAM_OPTION_IS_DOUBLE) then
      call this%set(row%id, real(value, c_double), stat, errmsg)
    else
      call this%set(row%id, value, stat, errmsg)
    end if
  end subroutine

  subroutine set_name_int32(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    integer(c_int32_t), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%set(name, int(value, c_int64_t), stat, errmsg)
  end subroutine

  subroutine set_name_float64(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    real(c_double), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer :: id

    id = id_of(name)
    if (id == 0) then
      call this%set(name, "0", stat, errmsg)
    else
      call this%set(id, value, stat, errmsg)
    end if
  end subroutine

  subroutine set_name_float32(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    real(c_float), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%set(name, real(value, c_double), stat, errmsg)
  end subroutine

  subroutine set_id_text(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    character(*), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call need_handle(this)
    call told(this, c_options_set_text(this%handle, id, trim(value)//c_null_char), stat, errmsg)
  end subroutine

  subroutine set_id_int64(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    integer(c_int64_t), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call need_handle(this)
    call told(this, c_options_set_int64(this%handle, id, value), stat, errmsg)
  end subroutine

  subroutine set_id_int32(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    integer(c_int32_t), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%set(id, int(value, c_int64_t), stat, errmsg)
  end subroutine

  subroutine set_id_float64(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    real(c_double), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call need_handle(this)
    call told(this, c_options_set_double(this%handle, id, value), stat, errmsg)
  end subroutine

  subroutine set_id_float32(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    real(c_float), intent(in) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%set(id, real(value, c_double), stat, errmsg)
  end subroutine

  ! ------------------------------------------------------------------------------------ getting

  subroutine get_id_text(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    character(:), allocatable, intent(inout) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: text
    integer(c_int32_t) :: status

    call need_handle(this)
    text = c_null_ptr
    status = c_options_get_text(this%handle, id, text)
    if (status >= 0) value = text_of(text)
    call told(this, status, stat, errmsg)
  end subroutine

  subroutine get_id_int64(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    integer(c_int64_t), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call need_handle(this)
    call told(this, c_options_get_int64(this%handle, id, value), stat, errmsg)
  end subroutine

  subroutine get_id_float64(this, id, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    integer, intent(in) :: id
    real(c_double), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call need_handle(this)
    call told(this, c_options_get_double(this%handle, id, value), stat, errmsg)
  end subroutine

  subroutine get_name_text(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    character(:), allocatable, intent(inout) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%get(id_of(name), value, stat, errmsg)
  end subroutine

  subroutine get_name_int64(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    integer(c_int64_t), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%get(id_of(name), value, stat, errmsg)
  end subroutine

  subroutine get_name_float64(this, name, value, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    real(c_double), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%get(id_of(name), value, stat, errmsg)
  end subroutine

  ! -------------------------------------------------------------------------- fields, and the end

  ! Measures a field with a weight, 1 unless it is given.
  subroutine options_add_field(this, name, weight, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    character(*), intent(in) :: name
    real(c_double), intent(in), optional :: weight
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double) :: factor

    factor = 1
    if (present(weight)) factor = weight
    call need_handle(this)
    call told(this, c_options_add_field(this%handle, trim(name)//c_null_char, factor), stat, errmsg)
  end subroutine

  ! Threads of the caller's, by a function in C that takes work; with c_null_funptr those of the library again.
  subroutine options_set_pool(this, submit, threads, user, stat, errmsg)
    class(tetstream_options), intent(inout) :: this
    type(c_funptr), intent(in) :: submit
    integer, intent(in) :: threads
    type(c_ptr), intent(in), optional :: user
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_pool_callbacks) :: pool

    call need_handle(this)
    if (.not. c_associated(submit)) then
      call told(this, c_options_set_pool(this%handle), stat, errmsg)
      return
    end if
    pool%struct_size = c_sizeof(pool)
    if (present(user)) pool%user = user
    pool%threads = threads
    pool%submit = submit
    call told(this, c_options_set_pool(this%handle, pool), stat, errmsg)
  end subroutine

  ! All have their defaults again.
  subroutine options_destroy(this)
    class(tetstream_options), intent(inout) :: this

    call c_options_destroy(this%handle)
    this%handle = c_null_ptr
  end subroutine

  impure elemental subroutine options_final(this)
    type(tetstream_options), intent(inout) :: this

    call this%destroy()
  end subroutine

  subroutine options_copy(this, other)
    class(tetstream_options), intent(inout) :: this
    class(tetstream_options), intent(in) :: other

    if (c_associated(this%handle) .or. c_associated(other%handle)) call refuse_copy("tetstream_options")
  end subroutine

end module
