#!/usr/bin/env python3
"""Finds names of the standard library, and types, constants and functions of lib/'s own headers, whose
header is not included, by the file itself or by a header of the project that it includes. The compiler does
not: where headers are precompiled, or a room is compiled as one file, all files see them. Prints a
line for each, and exits with 1 if there are any."""
import functools
import pathlib
import re
import sys

# Names that several headers declare stand with each of them.
NAMES = {
    "algorithm": """adjacent_find all_of any_of binary_search clamp copy copy_if copy_n count count_if equal fill fill_n find
        find_if find_if_not is_permutation lower_bound make_heap max max_element min min_element minmax
        minmax_element move_backward none_of nth_element partition partition_point pop_heap push_heap remove
        remove_if replace replace_if reverse search sort stable_partition stable_sort transform unique upper_bound""",
    "array": "array",
    "atomic": "atomic atomic_ref memory_order_relaxed",
    "bit": """bit_cast bit_ceil bit_floor bit_width countl_zero countr_zero endian has_single_bit
        popcount""",
    "charconv": "chars_format errc from_chars from_chars_result to_chars",
    "chrono": "chrono",
    "cmath": """abs acos cbrt ceil cos exp exp2 fabs floor fma fmax frexp ilogb isfinite isinf isnan ldexp nan
        expm1 llround log log10 log2 lround pow round sin sqrt trunc""",
    "condition_variable": "condition_variable",
    "cctype": "isalpha tolower",
    "cfenv": "fegetenv fenv_t fesetenv",
    "cstddef": "ptrdiff_t",
    "cstdio": "FILE fclose fgets fopen remove sscanf vsnprintf",
    "cstdlib": "abs atoi free getenv realloc strtol strtoul",
    "cstring": """memchr memcmp memcpy memmove memset strchr strcmp strcspn strerror strlen strncmp
        strrchr strspn""",
    "deque": "deque",
    "exception": "current_exception exception exception_ptr rethrow_exception",
    "functional": "function",
    "initializer_list": "initializer_list",
    "iterator": "back_inserter make_move_iterator next prev size",
    "limits": "numeric_limits",
    "list": "list",
    "map": "map",
    "memory": "enable_shared_from_this make_shared make_unique shared_ptr unique_ptr",
    "mutex": "lock_guard mutex recursive_mutex unique_lock",
    "new": "bad_alloc nothrow",
    "numbers": "numbers",
    "numeric": "iota partial_sum",
    "optional": "nullopt optional",
    "queue": "priority_queue",
    "set": "set",
    "shared_mutex": "shared_lock shared_mutex",
    "stdexcept": "length_error",
    "string": "string to_string",
    "string_view": "string_view",
    "system_error": "errc system_error",
    "thread": "this_thread thread",
    "tuple": "tie",
    "type_traits": """conditional_t is_enum_v is_floating_point_v is_integral_v is_same_v
        is_trivially_copyable_v is_void_v make_unsigned_t""",
    "unordered_map": "unordered_map",
    "utility": "declval exchange in_place in_range move pair swap",
    "variant": "variant",
    "vector": "vector",
}
# Of containers, each of which declares them for itself.
CONTAINERS = {"array", "deque", "list", "map", "set", "string", "string_view", "unordered_map",
              "vector"}
NAMES_OF_CONTAINERS = {"erase", "erase_if", "initializer_list", "size"}
ANYWHERE = {"get"}  # of tuples, pairs, arrays, variants
INTEGER = re.compile(r"\bu?int(?:8|16|32|64)_t\b")
# What a file declares: for all others at the start of a line, for itself anywhere.
DECLARED = (r"(?:(?:struct|class|enum class|enum) (\w+)|using (\w+) =|"
            r"(?:inline )?(?:static )?constexpr [\w:<>]+ (k[A-Z]\w*))")
FUNCTION = r"(?!return|else|using|typedef|throw)(?:[\w:]+(?:<.*>)?[ *&]+)+(\w+)\("
FREE_FUNCTION = re.compile("^" + FUNCTION, re.M)
ANY_FUNCTION = re.compile("^ *" + FUNCTION, re.M)
CALLED = re.compile(r"\b(\w+) = \[|\w (\w+)[,)]")  # lambdas and parameters
OF_A_HEADER, OF_A_FILE = re.compile("^" + DECLARED, re.M), re.compile(r"\b" + DECLARED)
ENUM = re.compile(r"\benum [^{};]*{([^}]*)}")

HEADERS = {}
for header, names in NAMES.items():
    for name in names.split():
        HEADERS.setdefault(name, set()).add(header)
for name in NAMES_OF_CONTAINERS:
    HEADERS.setdefault(name, set()).update(CONTAINERS)
HEADERS["string_view"].add("string")  # which is made from one
HEADERS["int64_t"] = {"cstdint"}  # and the others


def declared(pattern, text):
    return {name for found in pattern.findall(text) for name in found if name}


def main():
    root = pathlib.Path(__file__).resolve().parent.parent / "lib"
    files = [f for f in root.rglob("*") if f.suffix in (".h", ".cpp", ".inl")]
    by_name = {f.name: f for f in files}
    text = {f: re.sub(r"//.*", "", f.read_text()) for f in files}
    code = {f: re.sub(r'"[^"\n]*"', "", t) for f, t in text.items()}
    own = {}  # of each name the headers that declare it
    for file in files:
        if file.suffix != ".h":
            continue
        for name in declared(OF_A_HEADER, text[file]) | set(FREE_FUNCTION.findall(text[file])):
            own.setdefault(name, []).append(file)

    @functools.cache
    def seen_by(file):
        """The files, and the standard headers, that it includes, and those that they do."""
        found = set(re.findall(r"#include <(\w+)>", text[file])) | {file}
        for name in re.findall(r'#include "([\w.]+)"', text[file]):
            if name in by_name:
                found |= seen_by(by_name[name])
        return found

    @functools.cache
    def known_to(file):
        seen = [text[f] for f in seen_by(file) if f in text]
        members = " ".join(enum for t in seen for enum in ENUM.findall(t))
        own_names = {name for t in seen for name in declared(OF_A_FILE, t)}
        functions = {name for t in seen for name in ANY_FUNCTION.findall(t)}
        called = {name for found in CALLED.findall(text[file]) for name in found}
        return own_names | functions | called | set(re.findall(r"\w+", members)) | {"alignas"}

    def missing(file):
        used = set(re.findall(r"\bstd::(\w+)", text[file])) - ANYWHERE
        used |= {"int64_t"} if INTEGER.search(text[file]) else set()
        for name in sorted(used):
            if not HEADERS.get(name, set()) & seen_by(file):
                yield "std::" + name, [f"<{h}>" for h in sorted(HEADERS.get(name, ["?"]))]
        if file.suffix == ".inl":  # included where all is known
            return
        words = set(re.findall(r"(?<![\w.:])[A-Z]\w+|(?<![\w.:])k[A-Z]\w+", code[file]))
        words |= set(re.findall(r"(?<![\w.:>])([a-z]\w+)\(", code[file]))
        for name in sorted(words & set(own) - known_to(file)):
            yield name, [f'"{header.name}"' for header in own[name]]

    found = [(file, *what) for file in sorted(files) for what in missing(file)]
    for file, name, headers in found:
        print(f"{file.relative_to(root.parent)}: {name} without {' or '.join(headers)}")
    return len(found) > 0


sys.exit(main())
