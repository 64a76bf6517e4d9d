! The Fortran module passes on the results of C: texts, lists, answers, and a whole impact.
program module_test
  use, intrinsic :: iso_fortran_env, only: real64
  use pounding
  implicit none
  type(c_ptr) :: law
  type(pnd_contact) :: contact, copy
  type(pnd_response) :: answer
  type(pnd_free_impact) :: impact
  real(real64) :: state(PND_CONTACT_DOUBLES), force(3), tangent(3), lost(3), stiffness, yields
  integer :: i, wrong = 0
  logical :: found = .false.

  call expect('no error before the first', pnd_error_text() == '')
  call expect('a version', index(pnd_version(), '.') > 0)
  call status_is('an interface', 1, pnd_interface())
  do i = 1, pnd_law_count()
    if (pnd_law_name(i) == 'hertz_damped') found = .true.
  end do
  call expect('the list', found)
  call expect('nothing before the list', pnd_law_name(0) == '')
  call expect('nothing behind it', pnd_law_name(pnd_law_count() + 1) == '')

  call status_is('a refusal', PND_BAD_ARGUMENT, pnd_create('hertz_damp', '', [pnd_value('stiffness', 1d9)], law))
  call expect('its text', pnd_error_text() == 'unknown law "hertz_damp". Did you mean "hertz_damped"?')

  ! F = k d^1.5 (1 + a d'/v) with a = 3 (1 - e^2)/4, Lankarani & Nikravesh 1990.
  call status_is('a law', PND_OK, pnd_create('hertz_damped', 'lankarani_nikravesh', [pnd_value('stiffness', 1d9), &
                                             pnd_value('restitution', 0.5d0)], law))
  call status_is('a touch', PND_OK, pnd_touch(law, 0.8d0, contact))
  call expect('its speed', near(contact%closing_speed, 0.8d0))
  call status_is('a response', PND_OK, pnd_respond(law, contact, 1d-2, 0.4d0, answer))
  call expect('the force', near(answer%force, 1d6*(1 + 0.75d0*0.75d0/2)))
  call expect('the slope by penetration', near(answer%by_penetration, 1.5d8*(1 + 0.75d0*0.75d0/2)))
  call expect('the slope by rate', near(answer%by_rate, 1d6*0.75d0*0.75d0/0.8d0))
  call status_is('a step', PND_OK, pnd_accept(law, 1d-2, 0.4d0, contact))
  state = transfer(contact, state)
  copy = transfer(state, copy)
  call expect('a copy', near(copy%touching, 1d0) .and. near(copy%largest_penetration, 1d-2))
  call status_is('an end', PND_OK, pnd_separate(law, 0d0, contact))
  call expect('no impact', .not. contact%touching > 0)
  ! A target of 0.50 gives 0.725, as the law's catalogue states.
  call status_is('a free impact', PND_OK, pnd_collide(law, 6d4, 0.8d0, impact))
  call expect('its restitution', abs(impact%restitution - 0.725d0) < 5d-4)
  call pnd_destroy(law)

  ! 5 mm on a linear spring, back at 1/e^2 times the slope: an indentation of (1 - e^2) 5 mm remains.
  call status_is('a law that crushes', PND_OK, pnd_create('elastoplastic', 'exact', [pnd_value('stiffness', 1d8), &
                                             pnd_value('exponent', 1d0), pnd_value('restitution', 0.5d0)], law))
  call status_is('a press', PND_OK, pnd_accept(law, 5d-3, 0.3d0, contact))
  call status_is('its end', PND_OK, pnd_accept(law, 3.7d-3, -0.3d0, contact))
  call expect('its indentation', near(contact%indentation, 3.75d-3) .and. near(contact%crushed, 5d-3))
  call pnd_destroy(law)
  call pnd_destroy(c_null_ptr)

  ! A bilinear spring to four times its yield deformation of 7.5 mm, back, and again: (1 - a) Fy (dmax - dy) in the first quarter.
  call status_is('a law of yielding', PND_OK, pnd_create_yielding('bilinear', [pnd_value('stiffness', 2d7), &
                                             pnd_value('yield_force', 1.5d5), pnd_value('hardening', 0.1d0)], law))
  call status_is('its start', PND_OK, pnd_yielding_start(law, stiffness, yields))
  call expect('its stiffness', near(stiffness, 2d7) .and. near(yields, 7.5d-3))
  call status_is('a path', PND_OK, pnd_follow(law, [3d-2, -3d-2, 3d-2], force, tangent, lost))
  call expect('the forces', near(force(1), 1.95d5) .and. near(force(2), -1.95d5) .and. near(force(3), 1.95d5))
  call expect('the tangents', near(tangent(2), 2d6))
  call expect('what is lost', near(lost(1), 0.9d0*1.5d5*2.25d-2) .and. near(lost(3) - lost(1), 3.6d0*1.5d5*2.25d-2))
  call pnd_destroy_yielding(law)
  call status_is('a law with a word', PND_OK, pnd_create_yielding('menegotto_pinto', [pnd_value('stiffness', 2d7), &
                                             pnd_value('yield_force', 1.5d5)], law, [pnd_word('memory', 'last')]))
  call pnd_destroy_yielding(law)
  call status_is('a wrong word', PND_BAD_ARGUMENT, pnd_create_yielding('menegotto_pinto', [pnd_value('stiffness', 2d7), &
                                             pnd_value('yield_force', 1.5d5)], law, [pnd_word('memory', 'lost')]))
  call expect('its text', index(pnd_error_text(), 'cannot be "lost"') > 0)
  call expect('the list of laws of yielding', pnd_yielding_name(1) == 'bilinear' .and. pnd_yielding_name(0) == '' .and. &
              pnd_yielding_name(pnd_yielding_count() + 1) == '')
  call pnd_destroy_yielding(c_null_ptr)
  if (wrong > 0) error stop 1

contains

  subroutine expect(what, holds)
    character(*), intent(in) :: what
    logical, intent(in) :: holds
    if (holds) return
    print '(a)', 'not as expected: ' // what
    wrong = wrong + 1
  end subroutine

  subroutine status_is(what, right, status)
    character(*), intent(in) :: what
    integer(c_int), intent(in) :: right, status
    call expect(what, status == right)
  end subroutine

  logical function near(a, b)
    real(real64), intent(in) :: a, b
    near = abs(a/b - 1) < 1d-14
  end function

end program
