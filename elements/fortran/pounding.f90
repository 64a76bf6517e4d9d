!> Contact laws and hysteretic laws for Fortran: the functions of pounding.h, which documents units, signs and errors.
!>
!>     type(c_ptr) :: law
!>     type(pnd_contact) :: contact        ! two bodies that have never touched
!>     type(pnd_response) :: answer
!>     if (pnd_create('jankowski', 'exact', [pnd_value('stiffness', 2.75d9), pnd_value('restitution', 0.65d0), &
!>                    pnd_value('reduced_mass', 6d4)], law) /= PND_OK) print *, pnd_error_text()
!>     status = pnd_respond(law, contact, penetration, rate, answer)   ! any number of times: modifies nothing
!>     status = pnd_accept(law, penetration, rate, contact)            ! once per accepted step
!>     call pnd_destroy(law)
!>
!> Indices of laws start at 1 here. A hysteretic law is evaluated for whole arrays:
!>
!>     status = pnd_create_yielding('bouc_wen', [pnd_value('stiffness', 2d7), pnd_value('yield_force', 1.5d5)], storey)
!>     status = pnd_follow(storey, drift, force, tangent, lost)
!>     call pnd_destroy_yielding(storey)
module pounding
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_int, c_loc, c_null_char, &
    c_null_ptr, c_ptr, c_size_t
  implicit none
  private
  public :: c_ptr, c_null_ptr, c_double, c_int
  public :: pnd_value, pnd_contact, pnd_response, pnd_free_impact
  public :: pnd_create, pnd_destroy, pnd_touch, pnd_respond, pnd_accept, pnd_separate, pnd_collide
  public :: pnd_word, pnd_create_yielding, pnd_destroy_yielding, pnd_follow, pnd_yielding_start
  public :: pnd_yielding_count, pnd_yielding_name
  public :: pnd_error_text, pnd_version, pnd_interface, pnd_law_count, pnd_law_name

  integer(c_int), parameter, public :: PND_OK = 0, PND_BAD_ARGUMENT = 1, PND_OUT_OF_MEMORY = 2, PND_FAILED = 3
  !> Number of doubles in a pnd_contact, to store it among other state variables: transfer(contact, state) and
  !> transfer(state, contact).
  integer, parameter, public :: PND_CONTACT_DOUBLES = 8

  type :: pnd_value
    character(32) :: name
    real(c_double) :: value
  end type

  !> A parameter that takes a keyword, as in pnd_word('memory', 'last').
  type :: pnd_word
    character(32) :: name, word
  end type

  type, bind(C) :: pnd_contact
    real(c_double) :: touching = 0, indentation = 0, closing_speed = 0, damping = 0, largest_penetration = 0, slip = 0
    real(c_double) :: crushed = 0, reserved(1) = 0
  end type

  type, bind(C) :: pnd_response
    real(c_double) :: force = 0, by_penetration = 0, by_rate = 0
  end type

  type, bind(C) :: pnd_free_impact
    real(c_double) :: restitution = 0, peak_force = 0, peak_penetration = 0, time_of_peak = 0, duration = 0, impulse = 0
    real(c_double) :: energy_lost = 0
  end type

  type, bind(C) :: named_value
    type(c_ptr) :: name
    real(c_double) :: value
  end type

  type, bind(C) :: named_word
    type(c_ptr) :: name, word
  end type

  type, bind(C) :: yielding_info
    type(c_ptr) :: name, force, summary, source
    integer(c_size_t) :: parameters, choices
  end type

  type, bind(C) :: law_info
    type(c_ptr) :: name, force, summary, source
    integer(c_size_t) :: parameters, formulas
    integer(c_int) :: may_pull, leaves_indentation, instantaneous
  end type

  interface
    integer(c_int) function pnd_interface() bind(C)
      import :: c_int
    end function

    subroutine pnd_destroy(law) bind(C)
      import :: c_ptr
      type(c_ptr), value :: law
    end subroutine

    integer(c_int) function pnd_touch(law, closing_speed, contact) bind(C)
      import :: c_ptr, c_int, c_double, pnd_contact
      type(c_ptr), value :: law
      real(c_double), value :: closing_speed
      type(pnd_contact), intent(inout) :: contact
    end function

    integer(c_int) function pnd_respond(law, contact, penetration, rate, response) bind(C)
      import :: c_ptr, c_int, c_double, pnd_contact, pnd_response
      type(c_ptr), value :: law
      type(pnd_contact), intent(in) :: contact
      real(c_double), value :: penetration, rate
      type(pnd_response), intent(inout) :: response
    end function

    integer(c_int) function pnd_accept(law, penetration, rate, contact) bind(C)
      import :: c_ptr, c_int, c_double, pnd_contact
      type(c_ptr), value :: law
      real(c_double), value :: penetration, rate
      type(pnd_contact), intent(inout) :: contact
    end function

    integer(c_int) function pnd_separate(law, penetration, contact) bind(C)
      import :: c_ptr, c_int, c_double, pnd_contact
      type(c_ptr), value :: law
      real(c_double), value :: penetration
      type(pnd_contact), intent(inout) :: contact
    end function

    integer(c_int) function pnd_collide(law, reduced_mass, closing_speed, result) bind(C)
      import :: c_ptr, c_int, c_double, pnd_free_impact
      type(c_ptr), value :: law
      real(c_double), value :: reduced_mass, closing_speed
      type(pnd_free_impact), intent(inout) :: result
    end function

    integer(c_int) function create_in_c(law, formula, values, count, made) bind(C, name='pnd_create')
      import :: c_char, c_int, c_ptr, c_size_t, named_value
      character(kind=c_char), intent(in) :: law(*), formula(*)
      type(named_value), intent(in) :: values(*)
      integer(c_size_t), value :: count
      type(c_ptr), intent(out) :: made
    end function

    subroutine pnd_destroy_yielding(law) bind(C)
      import :: c_ptr
      type(c_ptr), value :: law
    end subroutine

    !> Initial stiffness [N/m] and yield deformation [m].
    integer(c_int) function pnd_yielding_start(law, stiffness, yield_deformation) bind(C)
      import :: c_ptr, c_int, c_double
      type(c_ptr), value :: law
      real(c_double), intent(inout) :: stiffness, yield_deformation
    end function

    integer(c_int) function create_yielding_in_c(law, values, count, words, word_count, made) bind(C, name='pnd_create_yielding')
      import :: c_char, c_int, c_ptr, c_size_t, named_value, named_word
      character(kind=c_char), intent(in) :: law(*)
      type(named_value), intent(in) :: values(*)
      type(named_word), intent(in) :: words(*)
      integer(c_size_t), value :: count, word_count
      type(c_ptr), intent(out) :: made
    end function

    integer(c_int) function follow_in_c(law, deformation, count, force, tangent, lost) bind(C, name='pnd_follow')
      import :: c_double, c_int, c_ptr, c_size_t
      type(c_ptr), value :: law
      real(c_double), intent(in) :: deformation(*)
      integer(c_size_t), value :: count
      real(c_double), intent(inout) :: force(*), tangent(*), lost(*)
    end function

    integer(c_size_t) function yielding_count_in_c() bind(C, name='pnd_yielding_count')
      import :: c_size_t
    end function

    integer(c_int) function describe_yielding_in_c(law, info) bind(C, name='pnd_describe_yielding')
      import :: c_int, c_size_t, yielding_info
      integer(c_size_t), value :: law
      type(yielding_info), intent(inout) :: info
    end function

    type(c_ptr) function error_text_in_c() bind(C, name='pnd_error_text')
      import :: c_ptr
    end function

    type(c_ptr) function version_in_c() bind(C, name='pnd_version')
      import :: c_ptr
    end function

    integer(c_size_t) function law_count_in_c() bind(C, name='pnd_law_count')
      import :: c_size_t
    end function

    integer(c_int) function describe_law_in_c(law, info) bind(C, name='pnd_describe_law')
      import :: c_int, c_size_t, law_info
      integer(c_size_t), value :: law
      type(law_info), intent(inout) :: info
    end function

    integer(c_size_t) function strlen(text) bind(C)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
    end function
  end interface

contains

  !> Creates a law; release it with pnd_destroy. Trailing blanks of names are ignored; an empty formula is 'exact'.
  integer(c_int) function pnd_create(law, formula, values, made) result(status)
    character(*), intent(in) :: law, formula
    type(pnd_value), intent(in) :: values(:)
    type(c_ptr), intent(out) :: made
    character(len(values%name) + 1, c_char), target :: names(size(values))
    type(named_value) :: pairs(size(values))
    integer :: i

    do i = 1, size(values)
      names(i) = trim(values(i)%name) // c_null_char
      pairs(i) = named_value(c_loc(names(i)), values(i)%value)
    end do
    status = create_in_c(trim(law) // c_null_char, trim(formula) // c_null_char, pairs, size(pairs, kind=c_size_t), made)
  end function

  !> Creates a hysteretic law; release it with pnd_destroy_yielding.
  integer(c_int) function pnd_create_yielding(law, values, made, words) result(status)
    character(*), intent(in) :: law
    type(pnd_value), intent(in) :: values(:)
    type(c_ptr), intent(out) :: made
    type(pnd_word), intent(in), optional :: words(:)
    character(len(values%name) + 1, c_char), target :: names(size(values))
    character(33, c_char), allocatable, target :: texts(:, :)
    type(named_value) :: pairs(size(values))
    type(named_word), allocatable :: chosen(:)
    integer :: i, count

    do i = 1, size(values)
      names(i) = trim(values(i)%name) // c_null_char
      pairs(i) = named_value(c_loc(names(i)), values(i)%value)
    end do
    count = 0
    if (present(words)) count = size(words)
    allocate (texts(2, count), chosen(count))
    do i = 1, count
      texts(1, i) = trim(words(i)%name) // c_null_char
      texts(2, i) = trim(words(i)%word) // c_null_char
      chosen(i) = named_word(c_loc(texts(1, i)), c_loc(texts(2, i)))
    end do
    status = create_yielding_in_c(trim(law) // c_null_char, pairs, size(pairs, kind=c_size_t), chosen, int(count, c_size_t), made)
  end function

  !> Evaluates the law along the deformations, from the undeformed state: force, tangent and dissipated energy, arrays
  !> of the same size.
  integer(c_int) function pnd_follow(law, deformation, force, tangent, lost) result(status)
    type(c_ptr), intent(in) :: law
    real(c_double), intent(in) :: deformation(:)
    real(c_double), intent(inout) :: force(size(deformation)), tangent(size(deformation)), lost(size(deformation))
    status = follow_in_c(law, deformation, size(deformation, kind=c_size_t), force, tangent, lost)
  end function

  integer function pnd_yielding_count() result(count)
    count = int(yielding_count_in_c())
  end function

  !> Name of hysteretic law 1 ... pnd_yielding_count(); empty if out of range.
  function pnd_yielding_name(law) result(text)
    integer, intent(in) :: law
    character(:), allocatable :: text
    type(yielding_info) :: info
    text = ''
    if (describe_yielding_in_c(int(law - 1, c_size_t), info) == PND_OK) text = text_of(info%name)
  end function

  !> Error text of the last failed call of this thread.
  function pnd_error_text() result(text)
    character(:), allocatable :: text
    text = text_of(error_text_in_c())
  end function

  !> Version of the library at run time, '0.3.0'.
  function pnd_version() result(text)
    character(:), allocatable :: text
    text = text_of(version_in_c())
  end function

  integer function pnd_law_count() result(count)
    count = int(law_count_in_c())
  end function

  !> Name of law 1 ... pnd_law_count(); empty if out of range.
  function pnd_law_name(law) result(text)
    integer, intent(in) :: law
    character(:), allocatable :: text
    type(law_info) :: info
    text = ''
    if (describe_law_in_c(int(law - 1, c_size_t), info) == PND_OK) text = text_of(info%name)
  end function

  function text_of(pointer) result(text)
    type(c_ptr), intent(in) :: pointer
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    call c_f_pointer(pointer, letters, [strlen(pointer)])
    allocate (character(size(letters)) :: text)
    do i = 1, size(letters)
      text(i:i) = letters(i)
    end do
  end function

end module pounding
