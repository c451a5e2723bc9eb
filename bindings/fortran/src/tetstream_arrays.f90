! Arrays of the four types that the library knows, as Fortran lays them out: (components, rows).
! tetstream_field is an array of the caller's that is lent; tetstream_array owns its values.
module tetstream_arrays
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures
  use tetstream_growth
  implicit none
  private
  public :: tetstream_field

  integer, parameter, public :: tetstream_real = c_double, tetstream_index = c_int64_t

  ! note: the name has a fixed length: gfortran 12 forgets allocatable components in [a, b]. One letter
  ! more than the library takes, so that it refuses what is longer.
  type :: tetstream_field
    character(256) :: name = ""
    integer :: components = 0
    integer :: type = 0
    integer(c_int64_t) :: rows = 0
    type(c_ptr) :: values = c_null_ptr
  end type

  interface tetstream_field
    module procedure lent_float32, lent_float32_rows, lent_float64, lent_float64_rows
    module procedure lent_int32, lent_int32_rows, lent_int64, lent_int64_rows
  end interface

  ! One of the four is allocated, (components, rows).
  type, public :: tetstream_array
    character(:), allocatable :: name
    real(c_float), allocatable :: float32(:, :)
    real(c_double), allocatable :: float64(:, :)
    integer(c_int32_t), allocatable :: int32(:, :)
    integer(c_int64_t), allocatable :: int64(:, :)
  contains
    procedure :: type => array_type
    procedure :: components => array_components
    procedure :: rows => array_rows
    procedure :: location => array_location
    procedure :: empty => array_empty
    procedure :: add => array_add
    procedure :: trim => array_trim
    procedure, private :: set_float32, set_float32_rows, set_float64, set_float64_rows
    procedure, private :: set_int32, set_int32_rows, set_int64, set_int64_rows
    generic :: set => set_float32, set_float32_rows, set_float64, set_float64_rows, &
      set_int32, set_int32_rows, set_int64, set_int64_rows
    procedure, private :: get_float32, get_float32_rows, get_float64, get_float64_rows
    procedure, private :: get_int32, get_int32_rows, get_int64, get_int64_rows
    generic :: get => get_float32, get_float32_rows, get_float64, get_float64_rows, &
      get_int32, get_int32_rows, get_int64, get_int64_rows
  end type

contains

  ! ------------------------------------------------------------------------------- lent arrays

  function lent(name, kind, components, rows, values) result(field)
    character(*), intent(in) :: name
    integer, intent(in) :: kind, components
    integer(c_int64_t), intent(in) :: rows
    type(c_ptr), intent(in) :: values
    type(tetstream_field) :: field

    field%name = name
    field%type = kind
    field%components = components
    field%rows = rows
    if (rows > 0) field%values = values
  end function

  function lent_float32(name, values) result(field)
    character(*), intent(in) :: name
    real(c_float), pointer, contiguous, intent(in) :: values(:)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_FLOAT32, 1, size(values, kind=c_int64_t), c_loc(values))
  end function

  function lent_float32_rows(name, values) result(field)
    character(*), intent(in) :: name
    real(c_float), pointer, contiguous, intent(in) :: values(:, :)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_FLOAT32, size(values, 1), size(values, 2, c_int64_t), c_loc(values))
  end function

  function lent_float64(name, values) result(field)
    character(*), intent(in) :: name
    real(c_double), pointer, contiguous, intent(in) :: values(:)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_FLOAT64, 1, size(values, kind=c_int64_t), c_loc(values))
  end function

  function lent_float64_rows(name, values) result(field)
    character(*), intent(in) :: name
    real(c_double), pointer, contiguous, intent(in) :: values(:, :)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_FLOAT64, size(values, 1), size(values, 2, c_int64_t), c_loc(values))
  end function

  function lent_int32(name, values) result(field)
    character(*), intent(in) :: name
    integer(c_int32_t), pointer, contiguous, intent(in) :: values(:)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_INT32, 1, size(values, kind=c_int64_t), c_loc(values))
  end function

  function lent_int32_rows(name, values) result(field)
    character(*), intent(in) :: name
    integer(c_int32_t), pointer, contiguous, intent(in) :: values(:, :)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_INT32, size(values, 1), size(values, 2, c_int64_t), c_loc(values))
  end function

  function lent_int64(name, values) result(field)
    character(*), intent(in) :: name
    integer(c_int64_t), pointer, contiguous, intent(in) :: values(:)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_INT64, 1, size(values, kind=c_int64_t), c_loc(values))
  end function

  function lent_int64_rows(name, values) result(field)
    character(*), intent(in) :: name
    integer(c_int64_t), pointer, contiguous, intent(in) :: values(:, :)
    type(tetstream_field) :: field
    field = lent(name, TETSTREAM_TYPE_INT64, size(values, 1), size(values, 2, c_int64_t), c_loc(values))
  end function

  ! ------------------------------------------------------------------------------ owned arrays

  ! TETSTREAM_TYPE_...; 0: nothing is allocated.
  pure integer function array_type(this)
    class(tetstream_array), intent(in) :: this

    array_type = 0
    if (allocated(this%float32)) array_type = TETSTREAM_TYPE_FLOAT32
    if (allocated(this%float64)) array_type = TETSTREAM_TYPE_FLOAT64
    if (allocated(this%int32)) array_type = TETSTREAM_TYPE_INT32
    if (allocated(this%int64)) array_type = TETSTREAM_TYPE_INT64
  end function

  pure integer function array_components(this)
    class(tetstream_array), intent(in) :: this

    array_components = int(extent(this, 1))
  end function

  pure function array_rows(this) result(rows)
    class(tetstream_array), intent(in) :: this
    integer(c_int64_t) :: rows

    rows = extent(this, 2)
  end function

  pure function extent(this, dimension)
    class(tetstream_array), intent(in) :: this
    integer, intent(in) :: dimension
    integer(c_int64_t) :: extent

    extent = 0
    if (allocated(this%float32)) extent = size(this%float32, dimension, c_int64_t)
    if (allocated(this%float64)) extent = size(this%float64, dimension, c_int64_t)
    if (allocated(this%int32)) extent = size(this%int32, dimension, c_int64_t)
    if (allocated(this%int64)) extent = size(this%int64, dimension, c_int64_t)
  end function

  ! Where the values lie, for C.
  function array_location(this) result(location)
    class(tetstream_array), intent(in), target :: this
    type(c_ptr) :: location

    location = c_null_ptr
    if (this%rows() == 0) return
    if (allocated(this%float32)) location = c_loc(this%float32)
    if (allocated(this%float64)) location = c_loc(this%float64)
    if (allocated(this%int32)) location = c_loc(this%int32)
    if (allocated(this%int64)) location = c_loc(this%int64)
  end function

  ! No rows, of that type and so many components.
  subroutine array_empty(this, type, components)
    class(tetstream_array), intent(inout) :: this
    integer, intent(in) :: type, components

    call forget(this)
    select case (type)
    case (TETSTREAM_TYPE_FLOAT32)
      allocate (this%float32(components, 0))
    case (TETSTREAM_TYPE_FLOAT64)
      allocate (this%float64(components, 0))
    case (TETSTREAM_TYPE_INT32)
      allocate (this%int32(components, 0))
    case (TETSTREAM_TYPE_INT64)
      allocate (this%int64(components, 0))
    end select
  end subroutine

  subroutine forget(this)
    class(tetstream_array), intent(inout) :: this

    if (allocated(this%float32)) deallocate (this%float32)
    if (allocated(this%float64)) deallocate (this%float64)
    if (allocated(this%int32)) deallocate (this%int32)
    if (allocated(this%int64)) deallocate (this%int64)
  end subroutine

  ! Puts rows that lie in C behind the first `count`; `failed` as of grow.
  subroutine array_add(this, count, values, rows, failed)
    class(tetstream_array), intent(inout) :: this
    integer(c_int64_t), intent(in) :: count, rows
    type(c_ptr), intent(in) :: values
    integer, intent(inout) :: failed
    real(c_float), pointer :: float32(:, :)
    real(c_double), pointer :: float64(:, :)
    integer(c_int32_t), pointer :: int32(:, :)
    integer(c_int64_t), pointer :: int64(:, :)
    integer(c_int64_t) :: shape(2)

    if (rows == 0) return
    shape = [int(this%components(), c_int64_t), rows]
    if (allocated(this%float32)) then
      call c_f_pointer(values, float32, shape)
      call grow(this%float32, count, float32, failed)
    else if (allocated(this%float64)) then
      call c_f_pointer(values, float64, shape)
      call grow(this%float64, count, float64, failed)
    else if (allocated(this%int32)) then
      call c_f_pointer(values, int32, shape)
      call grow(this%int32, count, int32, failed)
    else
      call c_f_pointer(values, int64, shape)
      call grow(this%int64, count, int64, failed)
    end if
  end subroutine

  ! Keeps the first `count` rows.
  subroutine array_trim(this, count)
    class(tetstream_array), intent(inout) :: this
    integer(c_int64_t), intent(in) :: count

    if (allocated(this%float32)) call shorten(this%float32, count)
    if (allocated(this%float64)) call shorten(this%float64, count)
    if (allocated(this%int32)) call shorten(this%int32, count)
    if (allocated(this%int64)) call shorten(this%int64, count)
  end subroutine

  ! ------------------------------------------------------------------- values in, with their type

  subroutine set_float32(this, values)
    class(tetstream_array), intent(inout) :: this
    real(c_float), intent(in) :: values(:)
    call forget(this)
    this%float32 = reshape(values, [1, size(values)])
  end subroutine

  subroutine set_float32_rows(this, values)
    class(tetstream_array), intent(inout) :: this
    real(c_float), intent(in) :: values(:, :)
    call forget(this)
    this%float32 = values
  end subroutine

  subroutine set_float64(this, values)
    class(tetstream_array), intent(inout) :: this
    real(c_double), intent(in) :: values(:)
    call forget(this)
    this%float64 = reshape(values, [1, size(values)])
  end subroutine

  subroutine set_float64_rows(this, values)
    class(tetstream_array), intent(inout) :: this
    real(c_double), intent(in) :: values(:, :)
    call forget(this)
    this%float64 = values
  end subroutine

  subroutine set_int32(this, values)
    class(tetstream_array), intent(inout) :: this
    integer(c_int32_t), intent(in) :: values(:)
    call forget(this)
    this%int32 = reshape(values, [1, size(values)])
  end subroutine

  subroutine set_int32_rows(this, values)
    class(tetstream_array), intent(inout) :: this
    integer(c_int32_t), intent(in) :: values(:, :)
    call forget(this)
    this%int32 = values
  end subroutine

  subroutine set_int64(this, values)
    class(tetstream_array), intent(inout) :: this
    integer(c_int64_t), intent(in) :: values(:)
    call forget(this)
    this%int64 = reshape(values, [1, size(values)])
  end subroutine

  subroutine set_int64_rows(this, values)
    class(tetstream_array), intent(inout) :: this
    integer(c_int64_t), intent(in) :: values(:, :)
    call forget(this)
    this%int64 = values
  end subroutine

  ! ---------------------------------------------------- values out, in any type that holds them all

  ! Whether what is there cannot be had in a type of the caller's: told as a failure.
  function unfit(this, is_fit, components, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    logical, intent(in) :: is_fit
    integer, intent(in) :: components
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    logical :: unfit
    character(:), allocatable :: name
    character(120) :: words

    name = "an array"
    if (allocated(this%name)) name = '"'//this%name//'"'
    unfit = .true.
    if (.not. is_fit) then
      call fail(TETSTREAM_BAD_ARGUMENT, name//": its values do not fit the type of the variable", stat, errmsg)
    else if (components > 0 .and. this%components() /= components) then
      write (words, "(a, i0, a)") ": it has ", this%components(), " components, the variable has one dimension"
      call fail(TETSTREAM_BAD_ARGUMENT, name//trim(words), stat, errmsg)
    else
      call finished(stat)
      unfit = .false.
    end if
  end function

  subroutine get_float32_rows(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    real(c_float), allocatable, intent(inout) :: values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, allocated(this%float32), 0, stat, errmsg)) return
    values = this%float32
  end subroutine

  subroutine get_float32(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    real(c_float), allocatable, intent(inout) :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, allocated(this%float32), 1, stat, errmsg)) return
    values = this%float32(1, :)
  end subroutine

  subroutine get_float64_rows(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    real(c_double), allocatable, intent(inout) :: values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, this%type() /= 0 .and. .not. allocated(this%int64), 0, stat, errmsg)) return
    if (allocated(this%float64)) values = this%float64
    if (allocated(this%float32)) values = this%float32
    if (allocated(this%int32)) values = this%int32
  end subroutine

  subroutine get_float64(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    real(c_double), allocatable, intent(inout) :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, this%type() /= 0 .and. .not. allocated(this%int64), 1, stat, errmsg)) return
    if (allocated(this%float64)) values = this%float64(1, :)
    if (allocated(this%float32)) values = this%float32(1, :)
    if (allocated(this%int32)) values = this%int32(1, :)
  end subroutine

  ! Integers of 64 bits are given to 32 if all of them fit: labels mostly do.
  pure logical function fits_int32(this)
    class(tetstream_array), intent(in) :: this

    fits_int32 = allocated(this%int32)
    if (allocated(this%int64)) fits_int32 = all(abs(this%int64) <= huge(1_c_int32_t))
  end function

  subroutine get_int32_rows(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    integer(c_int32_t), allocatable, intent(inout) :: values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, fits_int32(this), 0, stat, errmsg)) return
    if (allocated(this%int32)) values = this%int32
    if (allocated(this%int64)) values = int(this%int64, c_int32_t)
  end subroutine

  subroutine get_int32(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    integer(c_int32_t), allocatable, intent(inout) :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, fits_int32(this), 1, stat, errmsg)) return
    if (allocated(this%int32)) values = this%int32(1, :)
    if (allocated(this%int64)) values = int(this%int64(1, :), c_int32_t)
  end subroutine

  subroutine get_int64_rows(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    integer(c_int64_t), allocatable, intent(inout) :: values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, allocated(this%int32) .or. allocated(this%int64), 0, stat, errmsg)) return
    if (allocated(this%int32)) values = this%int32
    if (allocated(this%int64)) values = this%int64
  end subroutine

  subroutine get_int64(this, values, stat, errmsg)
    class(tetstream_array), intent(in) :: this
    integer(c_int64_t), allocatable, intent(inout) :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (unfit(this, allocated(this%int32) .or. allocated(this%int64), 1, stat, errmsg)) return
    if (allocated(this%int32)) values = this%int32(1, :)
    if (allocated(this%int64)) values = this%int64(1, :)
  end subroutine

end module
