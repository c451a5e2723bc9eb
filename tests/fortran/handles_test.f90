! Handles end with their variables: what was opened is closed once, whichever way they go.
module handles_cases
  use checks
  use tetstream
  implicit none

  integer :: opened = 0, closed = 0

  type, extends(tetstream_source) :: counted
  contains
    procedure :: open => counted_open
    procedure :: next => counted_next
    procedure :: close => counted_close
  end type

  ! A solver's own type, in which handles are members.
  type :: holder
    type(tetstream_reader) :: reader
    type(tetstream_options) :: options
    type(tetstream_writer), allocatable :: writers(:)
  end type

contains

  subroutine counted_open(this, info, stat, errmsg)
    class(counted), intent(inout) :: this
    type(tetstream_stream_info), intent(inout) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, stays => stat, stays_too => errmsg)
    end associate
    opened = opened + 1
    info%indexed = .true.
  end subroutine

  subroutine counted_next(this, batch, stat, errmsg)
    class(counted), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, empty => batch, stays => stat, stays_too => errmsg)
    end associate
  end subroutine

  subroutine counted_close(this)
    class(counted), intent(inout) :: this

    associate (unused => this)
    end associate
    closed = closed + 1
  end subroutine

  subroutine open_one(reader, source)
    type(tetstream_reader), intent(inout) :: reader
    type(counted), intent(inout), target :: source
    type(tetstream_stream_info) :: info

    call reader%create(source)
    call reader%get_info(info)
  end subroutine

  subroutine expect(count, what)
    integer, intent(in) :: count
    character(*), intent(in) :: what

    call check_equal(opened, count, what//": opened")
    call check_equal(closed, count, what//": closed")
    opened = 0
    closed = 0
  end subroutine

  subroutine local_variables(source)
    type(counted), intent(inout), target :: source
    type(tetstream_reader) :: reader

    call open_one(reader, source)
    call check(opened == 1 .and. closed == 0, "a reader that is open")
  end subroutine

  subroutine destroyed_by_hand(source)
    type(counted), intent(inout), target :: source
    type(tetstream_reader) :: reader

    call open_one(reader, source)
    call reader%destroy()
    call check_equal(closed, 1, "destroy closes at once")
    call reader%destroy()
  end subroutine

  subroutine used_again(source)
    type(counted), intent(inout), target :: source
    type(tetstream_reader) :: reader
    integer :: i

    do i = 1, 3
      call open_one(reader, source)
    end do
    call reader%generate("ball", 100_tetstream_index)
  end subroutine

  subroutine arrays_of_handles(sources)
    type(counted), intent(inout), target :: sources(:)
    type(tetstream_reader), allocatable :: readers(:)
    integer :: i

    allocate (readers(size(sources)))
    do i = 1, size(sources)
      call open_one(readers(i), sources(i))
    end do
    deallocate (readers)
    call check_equal(closed, size(sources), "deallocated")
    allocate (readers(2))
    call open_one(readers(2), sources(1))
  end subroutine

  subroutine members_of_types(source)
    type(counted), intent(inout), target :: source
    type(holder) :: local
    type(holder), pointer :: own

    call open_one(local%reader, source)
    call local%options%set("ratio", 0.5)
    allocate (local%writers(2))
    call local%writers(1)%create_memory("tets")
    allocate (own)
    call open_one(own%reader, source)
    deallocate (own)
    call check_equal(closed, 1, "a pointer's target")
  end subroutine

  ! All handles of a run, none destroyed, in the order of the compiler.
  subroutine a_whole_run
    type(tetstream_options) :: options
    type(tetstream_reader) :: reader, again
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier, idle
    type(tetstream_diagram) :: diagram
    type(tetstream_comparison) :: comparison
    integer :: stat
    character(300) :: errmsg

    call options%set("ratio", 0.5)
    call reader%generate("ball", 2000_tetstream_index)
    call writer%create_memory("tets")
    call simplifier%create(writer, options)
    call options%set("ratio", 0.1)
    call simplifier%run(reader)
    call simplifier%run(reader, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "a reader and a simplifier serve one run")
    call again%generate("ball", 500_tetstream_index)
    call diagram%create(10, 10)
    call diagram%read(again)
    call comparison%create()
    call idle%create(writer, options, stat, errmsg)
  end subroutine

  ! Handles that were never made: told, not crashed.
  subroutine nothing_was_made
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_diagram) :: diagram
    type(tetstream_comparison) :: comparison
    type(tetstream_stream_info) :: info
    type(tetstream_diagram_info) :: diagram_info
    type(tetstream_comparison_info) :: comparison_info
    type(tetstream_report) :: report
    integer(1), allocatable :: bytes(:)
    integer :: stat(8)
    character(300) :: errmsg

    call reader%get_info(info, stat(1))
    call writer%get_memory(bytes, stat(2))
    call simplifier%run(reader, stat(3), errmsg)
    call simplifier%get_report(report, stat(4))
    call diagram%get_info(diagram_info, stat(5))
    call comparison%get_info(comparison_info, stat(6))
    call tetstream_convert(reader, writer, stat=stat(7))
    call simplifier%create(writer, stat=stat(8))
    call check(all(stat < 0), "handles that were never made")
    call check(len_trim(errmsg) > 5, "with words")
    call check(reader%note(1) == "", "a reader has no notes")
    call check(writer%note(1) == "", "nor has a writer")
  end subroutine

end module

program handles_test
  use handles_cases
  implicit none
  type(counted), target, save :: sources(3)

  call local_variables(sources(1))
  call expect(1, "a local variable")
  call destroyed_by_hand(sources(1))
  call expect(1, "destroyed by hand")
  call used_again(sources(1))
  call expect(3, "used again")
  call arrays_of_handles(sources)
  call expect(4, "arrays")
  call members_of_types(sources(1))
  call expect(2, "members")
  call a_whole_run
  call nothing_was_made
  call check_end
end program
