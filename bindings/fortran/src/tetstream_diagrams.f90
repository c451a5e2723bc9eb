! Layout diagrams: how good the order of a stream is, as a picture and as numbers.
module tetstream_diagrams
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures
  use tetstream_figures
  use tetstream_listening
  use tetstream_readers
  use tetstream_settings
  implicit none
  private

  ! The raster of a diagram. Points are numbered from 1.
  type, public :: tetstream_raster
    real(c_float), allocatable :: coverage(:, :)    ! (columns, rows), 0 to 1
    integer(c_int64_t), allocatable :: widths(:)    ! (columns): active points, at most
    integer(c_int64_t), allocatable :: lowest(:)    ! the lowest active point
    integer(c_int64_t), allocatable :: newest(:)    ! the last point that was introduced
  end type

  type, public :: tetstream_diagram
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => diagram_create
    procedure :: read => diagram_read
    procedure :: get_info => diagram_get_info
    procedure :: get_raster => diagram_get_raster
    procedure :: write => diagram_write
    procedure :: check_path => diagram_check_path
    procedure :: destroy => diagram_destroy
    procedure, private :: diagram_copy
    generic :: assignment(=) => diagram_copy
    final :: diagram_final
  end type

contains

  ! A diagram whose raster has at most so many columns and rows.
  subroutine diagram_create(this, columns, rows, options, stat, errmsg)
    class(tetstream_diagram), intent(inout) :: this
    integer, intent(in) :: columns, rows
    type(tetstream_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%destroy()
    call told(this, c_diagram_create(handle_of(options), columns, rows, this%handle), stat, errmsg)
  end subroutine

  ! Reads everything. `page` is TETSTREAM_PAGE_SWEEP if that page is to be written, too.
  subroutine diagram_read(this, reader, page, progress, stat, errmsg)
    class(tetstream_diagram), intent(inout) :: this
    type(tetstream_reader), intent(inout) :: reader
    integer, intent(in), optional :: page
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(listener), target :: listens
    integer(c_int32_t) :: wanted, status

    wanted = TETSTREAM_PAGE_LAYOUT
    if (present(page)) wanted = page
    if (present(progress)) listens%told => progress
    status = c_diagram_read(this%handle, reader%handle, wanted, callback_of(listens), user_of(listens))
    call told(this, status, stat, errmsg, reader%cause())
  end subroutine

  ! The numbers; cells are counted from 1 there, 0: there are none.
  subroutine diagram_get_info(this, info, stat, errmsg)
    class(tetstream_diagram), intent(in) :: this
    type(tetstream_diagram_info), intent(inout) :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_diagram_info) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_diagram_get_info(this%handle, found)
    if (status >= 0) then
      call take(found, info)
      info%widest_cell = info%widest_cell + 1
      info%longest_cell = info%longest_cell + 1
    end if
    call told(this, status, stat, errmsg)
  end subroutine

  subroutine diagram_get_raster(this, raster, stat, errmsg)
    class(tetstream_diagram), intent(in) :: this
    type(tetstream_raster), intent(inout) :: raster
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_diagram_info) :: found
    real(c_float), pointer :: coverage(:, :)
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_diagram_get_info(this%handle, found)
    if (status >= 0 .and. c_associated(found%coverage)) then
      call c_f_pointer(found%coverage, coverage, [found%columns, found%rows])
      raster%coverage = coverage
      raster%widths = column(found%widths, found%columns)
      raster%lowest = column(found%lowest, found%columns) + 1
      raster%newest = column(found%newest, found%columns) + 1
    end if
    call told(this, status, stat, errmsg)
  end subroutine

  function column(from, count) result(copy)
    type(c_ptr), intent(in) :: from
    integer(c_int32_t), intent(in) :: count
    integer(c_int64_t), allocatable :: copy(:)
    integer(c_int64_t), pointer :: values(:)

    call c_f_pointer(from, values, [count])
    copy = values
  end function

  ! Draws a page, TETSTREAM_PAGE_LAYOUT or _SWEEP, as SVG or PNG by the path's extension.
  subroutine diagram_write(this, page, path, title, stat, errmsg)
    class(tetstream_diagram), intent(in) :: this
    integer, intent(in) :: page
    character(*), intent(in) :: path
    character(*), intent(in), optional :: title
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:, kind=c_char), allocatable :: words

    call terminated(title, words)
    call told(this, c_diagram_write(this%handle, page, trim(path)//c_null_char, words), stat, errmsg)
  end subroutine

  ! Whether `write` could draw to that path, as far as its extension and this build go.
  subroutine diagram_check_path(this, path, stat, errmsg)
    class(tetstream_diagram), intent(in) :: this
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call told(this, c_diagram_check_path(this%handle, trim(path)//c_null_char), stat, errmsg)
  end subroutine

  subroutine told(this, status, stat, errmsg, cause)
    class(tetstream_diagram), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(*), intent(in), optional :: cause

    call settle(status, c_diagram_message(this%handle), stat, errmsg, cause)
  end subroutine

  subroutine diagram_destroy(this)
    class(tetstream_diagram), intent(inout) :: this

    call c_diagram_destroy(this%handle)
    this%handle = c_null_ptr
  end subroutine

  impure elemental subroutine diagram_final(this)
    type(tetstream_diagram), intent(inout) :: this

    call this%destroy()
  end subroutine

  subroutine diagram_copy(this, other)
    class(tetstream_diagram), intent(inout) :: this
    class(tetstream_diagram), intent(in) :: other

    if (c_associated(this%handle) .or. c_associated(other%handle)) call refuse_copy("tetstream_diagram")
  end subroutine

end module
