! A sink that takes nothing but what it is told of a stream.
module sinks
  use tetstream
  implicit none
  private

  type, extends(tetstream_sink), public :: listening_sink
    type(tetstream_stream_info) :: info
  contains
    procedure :: open => listening_open
    procedure :: put => listening_put
  end type

contains

  subroutine listening_open(this, info, stat, errmsg)
    class(listening_sink), intent(inout) :: this
    type(tetstream_stream_info), intent(in) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (stays => stat, stays_too => errmsg)
    end associate
    this%info = info
  end subroutine

  subroutine listening_put(this, batch, stat, errmsg)
    class(listening_sink), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, not_looked_at => batch, stays => stat, stays_too => errmsg)
    end associate
  end subroutine

end module
