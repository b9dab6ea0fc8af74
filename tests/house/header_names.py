"""Tables of the headers that declare each name, for check_house.py. It reports names of std, glm or fmt that are in no
table, so that the tables stay complete."""

# A line starts with the header that the check proposes. Other headers that declare the names follow after bars.
STD = """
algorithm: adjacent_find all_of any_of binary_search clamp copy copy_backward copy_if copy_n count count_if equal
    equal_range fill fill_n find find_end find_first_of find_if find_if_not for_each for_each_n generate generate_n
    includes inplace_merge is_heap is_partitioned is_permutation is_sorted is_sorted_until
    lexicographical_compare lower_bound make_heap max max_element merge min min_element minmax minmax_element mismatch
    next_permutation none_of nth_element partial_sort partial_sort_copy partition partition_point pop_heap
    prev_permutation push_heap remove_copy remove_copy_if remove_if replace replace_if reverse reverse_copy rotate
    rotate_copy sample search set_difference set_intersection set_union shuffle sort sort_heap stable_partition
    stable_sort swap_ranges transform unique unique_copy upper_bound move_backward
algorithm|filesystem|cstdio: remove
any: any any_cast
array: array to_array
atomic: atomic atomic_bool atomic_flag atomic_int atomic_ref atomic_thread_fence memory_order memory_order_acquire
    memory_order_acq_rel memory_order_relaxed memory_order_release memory_order_seq_cst
barrier: barrier
bit: bit_cast bit_ceil bit_floor bit_width countl_one countl_zero countr_one countr_zero endian has_single_bit popcount
    rotl rotr
bitset: bitset
cctype: isalnum isalpha isdigit islower isprint ispunct isspace isupper isxdigit tolower toupper
charconv: chars_format from_chars to_chars from_chars_result to_chars_result
chrono: chrono chrono_literals
cmath: acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs fdim floor fma
    fmod frexp hypot ilogb isfinite isinf isnan isnormal ldexp lerp lgamma llround log log10 log1p log2 logb lround
    modf nan nanf nearbyint nextafter pow remainder rint round scalbn signbit sin sinh sqrt tan tanh tgamma trunc
cmath|cstdlib|complex: abs
cmath|complex: conj
compare: partial_ordering strong_ordering weak_ordering
complex: arg complex norm polar real imag
concepts: convertible_to copyable derived_from floating_point integral invocable regular same_as semiregular
    signed_integral totally_ordered unsigned_integral
condition_variable: condition_variable condition_variable_any cv_status
csetjmp: jmp_buf
csignal: raise sig_atomic_t signal
cstddef: byte max_align_t nullptr_t ptrdiff_t to_integer
cstddef|cstdio|cstdlib|cstring|ctime|array|map|set|span|string|string_view|vector: size_t
cstdint: int16_t int32_t int64_t int8_t intmax_t intptr_t uint16_t uint32_t uint64_t uint8_t uint_fast32_t uintmax_t
    uintptr_t
cstdio: FILE fclose feof fflush fgets fopen fprintf fputc fputs fread freopen fseek ftell fwrite getchar perror
    printf putchar puts rewind setvbuf snprintf sscanf tmpfile vsnprintf
cstdio|filesystem: rename
cstdlib: _Exit abort aligned_alloc atexit atof atoi calloc exit free getenv malloc quick_exit realloc strtod strtof
    strtol strtoll strtoul strtoull system
cstring: memchr memcmp memcpy memmove memset strcat strchr strcmp strcpy strerror strlen strncmp strncpy strrchr
    strstr
ctime: asctime clock clock_t ctime difftime gmtime localtime mktime strftime time time_t timespec tm
deque: deque
exception|stdexcept: exception
exception: current_exception exception_ptr make_exception_ptr rethrow_exception rethrow_if_nested
    set_terminate terminate throw_with_nested uncaught_exceptions
filesystem: filesystem
fstream: filebuf fstream ifstream ofstream
functional: bind bind_front bit_or cref divides equal_to function greater greater_equal identity invoke less
    less_equal logical_not mem_fn minus modulus multiplies negate not_fn plus ref reference_wrapper
functional|string|string_view|optional|memory|variant|filesystem: hash
future: async future future_status launch packaged_task promise shared_future
iomanip: get_time put_time quoted setfill setprecision setw
ios|fstream|iomanip|iostream|istream|ostream|sstream: boolalpha dec defaultfloat fixed hex ios ios_base left noshowpoint
    oct right scientific showpoint skipws streamoff streampos streamsize
iostream: cerr cin clog cout
istream|fstream|iostream|sstream: istream ws
iterator: advance back_insert_iterator back_inserter bidirectional_iterator_tag distance forward_iterator_tag
    front_inserter input_iterator_tag inserter istream_iterator istreambuf_iterator iterator_traits make_move_iterator
    make_reverse_iterator next ostream_iterator output_iterator_tag prev random_access_iterator_tag reverse_iterator
iterator|array|deque|list|map|set|span|string|string_view|vector|unordered_map|initializer_list: begin cbegin cend data
    empty end rbegin rend size ssize
latch: latch
limits: numeric_limits
list: list
locale: locale
map: map multimap
memory: addressof align allocator allocator_traits assume_aligned const_pointer_cast construct_at default_delete
    destroy_at dynamic_pointer_cast enable_shared_from_this make_shared make_unique shared_ptr static_pointer_cast
    to_address uninitialized_copy unique_ptr weak_ptr
mutex: call_once defer_lock lock lock_guard mutex once_flag recursive_mutex scoped_lock try_to_lock unique_lock
new: align_val_t bad_alloc bad_array_new_length hardware_destructive_interference_size launder nothrow
numbers: numbers
numeric: accumulate adjacent_difference exclusive_scan gcd inclusive_scan inner_product iota lcm midpoint partial_sum
    reduce transform_reduce
optional: bad_optional_access make_optional nullopt nullopt_t optional
ostream|fstream|iostream|sstream: endl flush ostream
queue: priority_queue queue
random: bernoulli_distribution discrete_distribution exponential_distribution minstd_rand mt19937 mt19937_64
    normal_distribution random_device seed_seq uniform_int_distribution uniform_real_distribution
ranges: views
ratio: milli micro nano ratio
regex: cmatch regex regex_match regex_replace regex_search smatch
semaphore: binary_semaphore counting_semaphore
set: multiset set
shared_mutex: shared_lock shared_mutex
source_location: source_location
span: as_bytes as_writable_bytes dynamic_extent span
sstream: istringstream ostringstream stringbuf stringstream
stack: stack
stdexcept: domain_error invalid_argument length_error logic_error out_of_range overflow_error range_error
    runtime_error underflow_error
stop_token: nostopstate stop_callback stop_source stop_token
streambuf|fstream|iostream|istream|ostream|sstream: streambuf
string: basic_string char_traits stod stof stoi stol stoll stoul stoull string string_literals to_string u8string
    wstring
string|istream: getline
string_view: basic_string_view string_view string_view_literals
system_error: errc error_category error_code error_condition generic_category make_error_code system_category
    system_error
thread: jthread this_thread thread
tuple: apply forward_as_tuple ignore make_from_tuple make_tuple tie tuple tuple_cat
tuple|array|utility: tuple_element tuple_element_t tuple_size tuple_size_v
tuple|utility|variant|array|map: get
type_traits: add_const_t add_pointer_t aligned_storage_t alignment_of bool_constant common_type_t conditional
    conditional_t decay decay_t enable_if enable_if_t extent_v false_type has_unique_object_representations_v
    integral_constant invoke_result_t is_arithmetic_v is_array_v is_base_of_v is_class_v is_const_v
    is_constant_evaluated is_convertible_v is_copy_constructible_v is_default_constructible_v is_empty_v is_enum
    is_enum_v is_floating_point is_floating_point_v is_function_v is_integral is_integral_v is_invocable
    is_invocable_r_v is_invocable_v is_move_constructible_v is_nothrow_move_constructible_v is_pointer_v
    is_reference_v is_same is_same_v is_signed_v is_standard_layout_v is_trivially_copyable_v
    is_trivially_destructible_v is_unsigned_v is_void_v make_signed_t make_unsigned_t remove_const_t remove_cv_t
    remove_cvref_t remove_extent_t remove_pointer_t remove_reference remove_reference_t true_type type_identity_t
    underlying_type underlying_type_t void_t
typeindex: type_index
typeinfo: type_info
unordered_map: unordered_map unordered_multimap
unordered_set: unordered_set
utility: as_const declval exchange forward index_sequence index_sequence_for integer_sequence in_place in_place_type
    make_index_sequence make_pair move piecewise_construct swap cmp_equal cmp_greater cmp_greater_equal cmp_less
    cmp_less_equal in_range to_underlying
utility|map: pair
valarray: valarray
variant: bad_variant_access get_if holds_alternative monostate variant variant_alternative_t variant_npos
    variant_size_v visit
vector|string|deque|list|map|set|unordered_map: erase erase_if
vector: vector
"""

GLM = """
glm/common.hpp: abs ceil clamp floor fract isinf isnan max min mix mod round sign smoothstep step trunc
glm/exponential.hpp: exp exp2 inversesqrt log log2 pow sqrt
glm/ext/matrix_transform.hpp|glm/gtc/matrix_transform.hpp: lookAt rotate scale translate
glm/vec2.hpp|glm/ext/vector_double2.hpp: dvec2
glm/vec3.hpp|glm/ext/vector_double3.hpp: dvec3
glm/vec4.hpp|glm/ext/vector_double4.hpp: dvec4
glm/vec2.hpp|glm/ext/vector_int2.hpp: ivec2
glm/geometric.hpp: cross distance dot faceforward length normalize reflect refract
glm/gtc/constants.hpp|glm/ext/scalar_constants.hpp: epsilon half_pi pi two_pi
glm/gtc/matrix_access.hpp: column row
glm/gtc/type_ptr.hpp: make_mat4 value_ptr
glm/mat2x2.hpp: dmat2 mat2 mat2x2
glm/mat3x3.hpp: dmat3 mat3 mat3x3
glm/mat4x4.hpp: dmat4 mat4 mat4x4
glm/matrix.hpp: determinant inverse outerProduct transpose
glm/trigonometric.hpp: acos asin atan cos degrees radians sin tan
glm/vec2.hpp: bvec2 uvec2 vec2
glm/vec3.hpp: bvec3 ivec3 uvec3 vec3
glm/vec4.hpp: ivec4 u8vec4 uvec4 vec4
glm/vector_relational.hpp: all any equal greaterThan greaterThanEqual lessThan lessThanEqual notEqual
glm/detail/qualifier.hpp|glm/vec2.hpp|glm/vec3.hpp|glm/mat3x3.hpp|glm/mat4x4.hpp: length_t mat qualifier vec
"""

# Newer versions of fmt declare fmt::join in fmt/ranges.h instead of fmt/format.h.
FMT = """
fmt/core.h|fmt/format.h: arg basic_runtime format format_args format_string format_to make_format_args print runtime
    string_view vformat
fmt/format.h: format_to_n formatted_size formatter memory_buffer to_string
fmt/ranges.h|fmt/format.h: join
"""

# Macros, and names without a namespace.
PLAIN = """
cassert: assert
cerrno: EAGAIN EEXIST EINTR EINVAL ENOENT ENOSPC errno
cfloat: DBL_EPSILON DBL_MAX DBL_MIN FLT_EPSILON FLT_MAX FLT_MIN
climits: CHAR_BIT INT_MAX INT_MIN UINT_MAX
csignal: SIGABRT SIGHUP SIGINT SIGKILL SIGPIPE SIGSEGV SIGTERM SIG_DFL SIG_IGN
cstdio: EOF stderr stdin stdout
cstdlib: EXIT_FAILURE EXIT_SUCCESS
cstdint: UINT16_MAX UINT32_MAX UINT64_MAX
"""

# System functions, called with a leading ::.
SYSTEM = """
cstdlib|stdlib.h: mkdtemp mkstemp setenv unsetenv
fcntl.h: open
signal.h|csignal: kill
sys/stat.h: fchmod stat
unistd.h: close fork fsync getpid isatty read syscall unlink write
"""

# The standard guarantees that these headers include <initializer_list>.
INITIALIZER_LIST = tuple("""initializer_list algorithm array deque list map random regex set string unordered_map
    unordered_set utility vector""".split())

ALL_OF_GLM = "glm/glm.hpp"


def table(text):
    """Returns a dictionary from names to the headers that declare them; the first is the one to propose."""
    names = {}
    headers = ()
    for line in text.strip().splitlines():
        if not line.startswith(" "):
            head, line = line.split(":", 1)
            headers = tuple(head.split("|"))
        for name in line.split():
            names[name] = headers
    return names
