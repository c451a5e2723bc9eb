! Options, statuses, tables: by name and by number, and what is refused.
module options_cases
  use, intrinsic :: iso_c_binding, only: c_associated, c_funloc, c_funptr, c_int32_t, c_null_funptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use checks
  use tetstream
  implicit none

contains

  subroutine options_keep_what_they_are_given
    type(tetstream_options) :: options
    real(real64) :: ratio
    integer(int64) :: cells
    character(:), allocatable :: text

    call options%get("ratio", ratio)
    call check(ratio == 0, "defaults hold before anything is set")
    call options%set("ratio", 0.25)
    call options%get(TETSTREAM_OPTION_RATIO, ratio)
    call check(ratio == 0.25, "a real by name")
    call options%set(TETSTREAM_OPTION_RATIO, 0.125_real64)
    call options%get("ratio", ratio)
    call check(ratio == 0.125, "a real by number")
    call options%set("error", 1)
    call options%get("error", ratio)
    call check(ratio == 1, "an integer for a real")
    call options%set("cells", 1000)
    call options%get("cells", cells)
    call check_equal(cells, 1000, "an integer by name")
    call options%set(TETSTREAM_OPTION_CELLS, 3000000000_int64)
    call options%get(TETSTREAM_OPTION_CELLS, cells)
    call check_equal(cells, 3000000000_int64, "a long integer by number")
    call options%set("memory", "64M")
    call options%get("memory", cells)
    call check_equal(cells, 64*2**20, "a text as on a command line")
    call options%set("order", "hilbert   ")
    call options%get("order", text)
    call check(text == "hilbert" .and. len(text) == 7, "blanks at the end do not count")
    call options%set(TETSTREAM_OPTION_MODE, "queue")
    call options%get(TETSTREAM_OPTION_MODE, text)
    call check(text == "queue", "a text by number")
    call options%add_field("pressure")
    call options%add_field("velocity", 0.5_real64)
    call options%destroy()
    call options%get("ratio", ratio)
    call check(ratio == 0, "after destroy all are defaults again")
  end subroutine

  subroutine what_is_no_option_is_refused
    type(tetstream_options) :: options
    type(c_funptr) :: submit
    integer(int64) :: cells
    integer :: stat
    character(200) :: errmsg

    errmsg = "as it was"
    call options%set("ratio", 0.5, stat, errmsg)
    call check(stat == TETSTREAM_OK .and. errmsg == "as it was", "success leaves errmsg as it was")
    call options%set("ratio", 1.5, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a ratio above 1")
    call check_says(errmsg, "ratio", "the option is named")
    call options%set("no-such", 1, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a name that is none")
    call check_says(errmsg, "no-such", "it is named")
    call options%set("no-such", 1.5, stat, errmsg)
    call check_says(errmsg, "no-such", "with a real, too")
    call options%set("no-such", "a", stat, errmsg)
    call check_says(errmsg, "no-such", "and a text")
    call options%set(99999, 1, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a number that is none")
    call options%set("cells", 1.5, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a real for an integer")
    call options%set("mode", "loud", stat, errmsg)
    call check_says(errmsg, "loud", "a choice that is none")
    call options%get("mode", cells, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "another type")
    submit = c_funloc(refuse)
    call options%set_pool(submit, -1, stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a pool of fewer threads than none")
    call options%set_pool(submit, 3, stat=stat)
    call check_equal(stat, 0, "a pool")
    call options%set_pool(c_null_funptr, 0, stat=stat)
    call check_equal(stat, 0, "and none again")
    call options%add_field("", 1._real64, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a field without a name")
    call options%add_field("p", -1._real64, stat)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a negative weight, without a word asked for")
  end subroutine

  subroutine tables_are_told
    type(tetstream_option_info) :: row
    type(tetstream_format) :: format
    integer :: i, stat
    logical :: has_ratio, has_cells, writes_vtu
    character(200) :: errmsg

    has_ratio = .false.
    has_cells = .false.
    do i = 1, tetstream_option_count()
      call tetstream_option_at(i, row)
      if (row%id == TETSTREAM_OPTION_RATIO) has_ratio = row%name == "ratio" .and. row%maximum == 1 .and. &
        row%type == TETSTREAM_OPTION_IS_DOUBLE .and. len(row%text) > 20
      if (row%id == TETSTREAM_OPTION_CELLS) has_cells = row%lowest == 0 .and. row%highest == huge(row%highest)
    end do
    call check(i > 12 .and. has_ratio .and. has_cells, "options are listed from 1 on")
    call tetstream_option_at(0, row, stat)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "there is no row 0")
    call tetstream_option_at(i, row, stat, errmsg)
    call check_says(errmsg, "TETSTREAM_BAD_ARGUMENT", "nor one past the end")
    writes_vtu = .false.
    i = 0
    do
      i = i + 1
      call tetstream_format_at(i, format, stat)
      if (stat < 0) exit
      if (format%name == "vtu") writes_vtu = format%can_read .and. format%can_write
    end do
    call check(i > 5 .and. writes_vtu, "formats are listed from 1 on")
    call check(tetstream_status_name(TETSTREAM_BAD_DATA) == "TETSTREAM_BAD_DATA", "statuses have names")
    call check_equal(tetstream_library_version(), TETSTREAM_VERSION_NUMBER, "library and module are of one version")
    call check_says(tetstream_version_text(), "0.", "which has words")
  end subroutine

  ! A pool that takes no work.
  integer(c_int32_t) function refuse(user, work, argument) bind(c)
    type(c_ptr), value :: user, argument
    type(c_funptr), value :: work

    refuse = 1
    if (c_associated(user) .and. c_associated(work) .and. c_associated(argument)) refuse = 2
  end function

end module

program options_test
  use options_cases
  implicit none

  call options_keep_what_they_are_given
  call what_is_no_option_is_refused
  call tables_are_told
  call check_end

end program
