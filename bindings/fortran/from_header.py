"""from_header.py INCLUDE FOLDER: writes what the header says of constants, structs and functions as the
Fortran modules tetstream_constants, tetstream_c and tetstream_figures. A declaration that it does not understand is an
error: nothing is left out silently."""
import pathlib
import re
import sys

SCALARS = {
    "size_t": "integer(c_size_t)", "int32_t": "integer(c_int32_t)", "uint32_t": "integer(c_int32_t)",
    "int64_t": "integer(c_int64_t)", "uint64_t": "integer(c_int64_t)", "double": "real(c_double)",
    "tetstream_status": "integer(c_int32_t)"}
ZEROS = {"integer": "0", "real": "0", "type(c_ptr)": "c_null_ptr", "type(c_funptr)": "c_null_funptr"}
# What the modules by hand have a type of their own for.
BY_HAND = re.compile(r"_(column|stream_info|batch|map_rows|log_rows|callbacks)$")


def stop(what):
    sys.exit(f"from_header.py: {what}")


def c_name(name):
    return name.replace("tetstream_", "c_", 1)


def zero_of(kind):
    return next(zero for start, zero in ZEROS.items() if kind.startswith(start))


class Member:
    """A member of a struct: its name, its type in Fortran, its extent ("" or "(3)"), and whether it
    is a text."""

    def __init__(self, words, text):
        function = re.fullmatch(r"\w+ \(\*(\w+)\)\(.*\)", text)
        plain = re.fullmatch(r"(?:const )?(\w+)((?:[ *]|\bconst\b)*)\b(\w+)(\[\d+\])?", text)
        if not function and not plain:
            stop(f"a member of {words}: {text}")
        self.is_text, self.extent = False, ""
        if function:
            self.name, self.kind = function[1], "type(c_funptr)"
        else:
            self.name, pointer = plain[3], "*" in plain[2]
            self.is_text = pointer and plain[1] == "char"
            if not pointer and plain[1] not in SCALARS:
                stop(f"the type of a member of {words}: {text}")
            self.kind = "type(c_ptr)" if pointer else SCALARS[plain[1]]
            self.extent = (plain[4] or "").replace("[", "(").replace("]", ")")


def members_of(name, body):
    for declaration in filter(None, (part.strip() for part in body.split(";"))):
        # "const int64_t a, b" is two members.
        first, *rest = re.split(r", (?![^(]*\))", declaration)
        yield (member := Member(name, first))
        for more in rest:
            yield Member(name, first[:first.rindex(member.name)] + more)


class Header:
    def __init__(self, include):
        text = "".join((include / "tetstream" / name).read_text()
                       for name in ("version.h", "tetstream.h"))
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S).replace("\\\n", " ")
        self.constants = re.findall(r"^#define (TETSTREAM_\w+)[ ]+(\S.*?)[ ]*$", text, re.M)
        self.constants = [pair for pair in self.constants if pair[0] != "TETSTREAM_API"]
        text = re.sub(r"\s+", " ", re.sub(r"^#.*$", "", text, flags=re.M))
        self.structs = {name: list(members_of(name, body)) for body, name in
                        re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", text)}
        self.handles = set(re.findall(r"typedef struct \w+ (tetstream_\w+);", text))
        self.functions = re.findall(r"TETSTREAM_API (.*?)\b(tetstream_\w+)\((.*?)\);", text)
        if text.count("TETSTREAM_API") != len(self.functions) or len(self.functions) < 50:
            stop(f"only {len(self.functions)} functions were understood")
        if text.count("typedef struct") != len(self.structs) + len(self.handles):
            stop(f"only {len(self.structs)} structs were understood")

    def argument(self, function, text):
        """Its name, and how Fortran declares it."""
        parts = re.fullmatch(r"(const )?(\w+) ?(\**)(\w+)", text)
        if not parts:
            stop(f"an argument of {function}: {text}")
        constant, kind, stars, name = parts.groups()
        if kind == "tetstream_progress_callback":
            return name, "type(c_funptr), value"
        if stars == "":
            return name, f"{SCALARS[kind]}, value"
        if stars == "**":
            return name, "type(c_ptr), intent(inout), optional"
        if kind == "char":
            return f"{name}(*)", "character(kind=c_char), intent(in), optional"
        if kind == "void" or kind in self.handles:
            return name, "type(c_ptr), value"
        if kind in self.structs:
            return name, f"type({c_name(kind)}), intent({'in' if constant else 'inout'}), optional"
        return name, f"{SCALARS[kind]}, intent(inout), optional"


HEAD = """! Made from tetstream.h by from_header.py: do not edit.
"""


def constants_module(header):
    yield from (HEAD + "module tetstream_constants", "  use, intrinsic :: iso_c_binding, only: c_int32_t",
                "  implicit none", "  private :: c_int32_t")
    for name, value in header.constants:
        value = value.replace(" + ", " + &\n      ")  # lines of 132 columns
        yield f"  integer(c_int32_t), parameter :: {name} = {value}"
    yield "end module"


def raw_module(header):
    """Structs and functions as C has them."""
    yield from (HEAD + "module tetstream_c", "  use, intrinsic :: iso_c_binding",
                "  use tetstream_constants", "  implicit none")
    for struct, members in header.structs.items():
        yield f"  type, bind(c) :: {c_name(struct)}"
        for member in members:
            yield f"    {member.kind} :: {member.name}{member.extent} = {zero_of(member.kind)}"
        yield "  end type"
    yield "  interface"
    for result, name, arguments in header.functions:
        result = result.strip()
        declared = [header.argument(name, text.strip()) for text in arguments.split(",")
                    if text.strip() != "void"]
        names = ", &\n        ".join(re.sub(r"\(.*", "", argument) for argument, _ in declared)
        word = "subroutine" if result == "void" else "function"
        yield f'    {word} {c_name(name)}( &\n        {names}) bind(c, name="{name}")'
        yield "      import"
        for argument, kind in declared:
            yield f"      {kind} :: {argument}"
        if word == "function":
            kind = "type(c_ptr)" if result.endswith("*") else SCALARS[result]
            yield f"      {kind} :: {c_name(name)}"
        yield f"    end {word}"
    yield from ("  end interface", "end module")


def figures_module(header):
    """Structs of figures as types whose texts are Fortran's own; `take` copies one."""
    figures = {name: [member for member in members if member.name != "struct_size" and
                      (member.is_text or member.kind != "type(c_ptr)")]
               for name, members in header.structs.items() if not BY_HAND.search(name)}
    yield from (HEAD + "module tetstream_figures", "  use, intrinsic :: iso_c_binding",
                "  use tetstream_c", "  use tetstream_failures, only: text_of", "  implicit none",
                "  private", "  public :: take")
    for name, members in figures.items():
        yield f"  type, public :: {name}"
        for member in members:
            if member.is_text:
                yield f"    character(:), allocatable :: {member.name}"
            else:
                yield f"    {member.kind} :: {member.name}{member.extent} = {zero_of(member.kind)}"
        yield "  end type"
    yield "  interface take"
    for name in figures:
        yield f"    module procedure take_{name.removeprefix('tetstream_')}"
    yield from ("  end interface", "contains")
    for name, members in figures.items():
        short = name.removeprefix("tetstream_")
        yield f"  subroutine take_{short}(from, to)"
        yield f"    type({c_name(name)}), intent(in) :: from"
        yield f"    type({name}), intent(inout) :: to"
        for member in members:
            value = f"from%{member.name}"
            yield f"    to%{member.name} = {f'text_of({value})' if member.is_text else value}"
        yield "  end subroutine"
    yield "end module"


def main(include, folder):
    header = Header(pathlib.Path(include))
    for name, lines in (("tetstream_constants", constants_module(header)),
                        ("tetstream_c", raw_module(header)),
                        ("tetstream_figures", figures_module(header))):
        pathlib.Path(folder, f"{name}.f90").write_text("\n".join(lines) + "\n")


main(*sys.argv[1:])
