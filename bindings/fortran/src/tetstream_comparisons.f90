! Comparisons: how well a simplified mesh stands for its original.
module tetstream_comparisons
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures
  use tetstream_figures
  use tetstream_listening
  use tetstream_readers
  use tetstream_settings
  implicit none
  private

  type, public :: tetstream_comparison
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create => comparison_create
    procedure :: read => comparison_read
    procedure :: get_info => comparison_get_info
    procedure :: get_mesh => comparison_get_mesh
    procedure :: get_field => comparison_get_field
    procedure :: get_region => comparison_get_region
    procedure :: get_face_label => comparison_get_face_label
    procedure :: write => comparison_write
    procedure :: check_path => comparison_check_path
    procedure :: destroy => comparison_destroy
    procedure, private :: comparison_copy
    generic :: assignment(=) => comparison_copy
    final :: comparison_final
  end type

contains

  subroutine comparison_create(this, options, stat, errmsg)
    class(tetstream_comparison), intent(inout) :: this
    type(tetstream_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%destroy()
    call told(this, c_comparison_create(handle_of(options), this%handle), stat, errmsg)
  end subroutine

  ! Reads both meshes to their ends and compares them.
  subroutine comparison_read(this, original, simplified, progress, stat, errmsg)
    class(tetstream_comparison), intent(inout) :: this
    type(tetstream_reader), intent(inout) :: original, simplified
    procedure(tetstream_listen), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(listener), target :: listens
    integer(c_int32_t) :: status

    if (present(progress)) listens%told => progress
    status = c_comparison_read(this%handle, original%handle, simplified%handle, callback_of(listens), &
                               user_of(listens))
    call told(this, status, stat, errmsg, trim(original%cause())//simplified%cause())
  end subroutine

  subroutine comparison_get_info(this, info, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    type(tetstream_comparison_info), intent(inout) :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_comparison_info) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_comparison_get_info(this%handle, found)
    if (status >= 0) call take(found, info)
    call told(this, status, stat, errmsg)
  end subroutine

  ! Of one mesh: TETSTREAM_ORIGINAL or TETSTREAM_SIMPLIFIED.
  subroutine comparison_get_mesh(this, mesh, figures, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    integer, intent(in) :: mesh
    type(tetstream_mesh_figures), intent(inout) :: figures
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_mesh_figures) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_comparison_get_mesh(this%handle, mesh, found)
    if (status >= 0) call take(found, figures)
    call told(this, status, stat, errmsg)
  end subroutine

  ! Fields, regions and labels of faces are counted from 1.
  subroutine comparison_get_field(this, index, field, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    integer, intent(in) :: index
    type(tetstream_field_comparison), intent(inout) :: field
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_field_comparison) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_comparison_get_field(this%handle, index - 1, found)
    if (status >= 0) call take(found, field)
    call told(this, status, stat, errmsg)
  end subroutine

  subroutine comparison_get_region(this, index, region, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    integer, intent(in) :: index
    type(tetstream_region_comparison), intent(inout) :: region
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_region_comparison) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_comparison_get_region(this%handle, index - 1, found)
    if (status >= 0) call take(found, region)
    call told(this, status, stat, errmsg)
  end subroutine

  subroutine comparison_get_face_label(this, index, face_label, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    integer, intent(in) :: index
    type(tetstream_face_label_comparison), intent(inout) :: face_label
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_face_label_comparison) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_comparison_get_face_label(this%handle, index - 1, found)
    if (status >= 0) call take(found, face_label)
    call told(this, status, stat, errmsg)
  end subroutine

  ! Draws a cut through both meshes, where the option `cut` was given.
  subroutine comparison_write(this, path, title, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: title
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:, kind=c_char), allocatable :: words

    call terminated(title, words)
    call told(this, c_comparison_write(this%handle, trim(path)//c_null_char, words), stat, errmsg)
  end subroutine

  ! Whether `write` could draw to that path, as far as its extension and this build go.
  subroutine comparison_check_path(this, path, stat, errmsg)
    class(tetstream_comparison), intent(in) :: this
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call told(this, c_comparison_check_path(this%handle, trim(path)//c_null_char), stat, errmsg)
  end subroutine

  subroutine told(this, status, stat, errmsg, cause)
    class(tetstream_comparison), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(*), intent(in), optional :: cause

    call settle(status, c_comparison_message(this%handle), stat, errmsg, cause)
  end subroutine

  subroutine comparison_destroy(this)
    class(tetstream_comparison), intent(inout) :: this

    call c_comparison_destroy(this%handle)
    this%handle = c_null_ptr
  end subroutine

  impure elemental subroutine comparison_final(this)
    type(tetstream_comparison), intent(inout) :: this

    call this%destroy()
  end subroutine

  subroutine comparison_copy(this, other)
    class(tetstream_comparison), intent(inout) :: this
    class(tetstream_comparison), intent(in) :: other

    if (c_associated(this%handle) .or. c_associated(other%handle)) call refuse_copy("tetstream_comparison")
  end subroutine

end module
