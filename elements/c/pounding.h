/* Contact laws and laws of yielding for C, Fortran, and whatever calls C.
 *
 *     pnd_law *law = NULL;
 *     const pnd_value values[] = {{"stiffness", 2.75e9}, {"restitution", 0.65}, {"reduced_mass", 6e4}};
 *     pnd_contact contact = {0};
 *     pnd_response answer;
 *     if (pnd_create("jankowski", "exact", values, 3, &law) != PND_OK) puts(pnd_error_text());
 *
 *     pnd_respond(law, &contact, penetration, rate, &answer);    // as often as the solver asks: nothing is changed
 *     pnd_accept(law, penetration, rate, &contact);              // once for each step that is kept
 *     pnd_destroy(law);
 *
 * Signs: penetration [m] > 0 is overlap (minus the opening of the gap), rate [m/s] > 0 closes, force [N] > 0 pushes the
 * bodies apart. SI units.
 *
 * Errors: a function that returns a status returns PND_OK, or another pnd_status and has changed nothing; the text of
 * the last error of the calling thread is pnd_error_text(). Null pointers are errors, not crashes.
 *
 * Threads: every function may be called from several threads at once. A law never changes after pnd_create, so threads
 * may share it; a pnd_contact is the caller's own data. Nothing else is kept, but for one error text a thread.
 *
 * Binary interface: functions, types and numbers of PND_INTERFACE n stay as they are in all later libraries with the
 * same n, which is the number in libpounding_c.so.n. Functions, status values, needs, laws and their parameters may be
 * added.
 */
#ifndef POUNDING_H
#define POUNDING_H

#include <stddef.h>

#if defined(__GNUC__)
#define PND_API __attribute__((visibility("default")))
#else
#define PND_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PND_INTERFACE 1

/* PND_INTERFACE of the library at run time. */
PND_API int pnd_interface(void);
/* Version of the library at run time, "0.3.0". Lives as long as the library. */
PND_API const char* pnd_version(void);

/* ---- Errors ---- */

/* Values that functions return. */
enum pnd_status {
  PND_OK = 0,
  PND_BAD_ARGUMENT = 1, /* an unknown name, a wrong value, a null pointer; the text says what is allowed */
  PND_OUT_OF_MEMORY = 2,
  PND_FAILED = 3 /* a calculation that found no answer */
};

/* Error text of the last failed call of this thread, at most 511 bytes; "" before the first failure. Lives until the
 * next failure of this thread. */
PND_API const char* pnd_error_text(void);

/* ---- Laws ---- */

/* A checked law with its parameters. */
typedef struct pnd_law pnd_law;

/* A parameter by its name. */
typedef struct pnd_value {
  const char* name;
  double value; /* in the unit of the parameter, see pnd_parameter */
} pnd_value;

/* Makes the law of this name, which pnd_destroy must end. The values are those of its own parameters, and restitution
 * [-], impact_velocity [m/s] and reduced_mass [kg] where it takes them; each at most once. A law that needs no mass
 * ignores reduced_mass. `formula` says how the damping follows from the restitution: "exact", or a published formula of
 * the law; NULL or "" is "exact". PND_BAD_ARGUMENT: an unknown law, formula or parameter (the text names the nearest
 * one), a parameter that is missing, a value outside its range, damping that is given twice or not at all. *made is
 * NULL then. */
PND_API int pnd_create(const char* law, const char* formula, const pnd_value* values, size_t count, pnd_law** made);
/* NULL is allowed. */
PND_API void pnd_destroy(pnd_law* law);

/* ---- An impact ---- */

/* History of the impacts of a link. Zeros are two bodies that never touched; a host whose bodies are pressed together
 * from the start calls pnd_accept at that state, with the rate 0, and gives the law an impact_velocity where it takes
 * one. All doubles, so that a host may keep it among its own state variables; a copy of it takes a step back. */
typedef struct pnd_contact {
  double touching;    /* 1 while an impact lasts, else 0 */
  double indentation; /* what komodromos, elastoplastic and backfill have added to the gap; taken off every penetration
                         [m] */
  double closing_speed;       /* of this impact, or the fixed design velocity [m/s] */
  double damping;             /* the law's coefficient for this impact, in the law's own unit */
  double largest_penetration; /* so far in this impact [m] */
  double slip;                /* plastic slip of bilinear_hertz [m] */
  double crushed;             /* deepest penetration of the impacts before, of elastoplastic and backfill [m] */
  double reserved[1];         /* zero */
} pnd_contact;
#define PND_CONTACT_DOUBLES 8

/* Response of a law to a state: the force and its two slopes. */
typedef struct pnd_response {
  double force;          /* [N] */
  double by_penetration; /* slope dF/dd [N/m] */
  double by_rate;        /* slope dF/dd' [N s/m] */
} pnd_response;

/* An impact begins at this closing speed >= 0 [m/s], from which the damping follows. For a host that locates the touch,
 * and calls pnd_accept from the next kept state on, where the bodies overlap; the others leave it to pnd_accept.
 * PND_BAD_ARGUMENT: also while an impact lasts. */
PND_API int pnd_touch(const pnd_law* law, double closing_speed, pnd_contact* contact);

/* Force and slopes at a state; zero unless an impact lasts and the bodies overlap. Only kelvin_voigt ever pulls. */
PND_API int pnd_respond(const pnd_law* law, const pnd_contact* contact, double penetration, double rate,
                        pnd_response* response);

/* A state was kept. Bodies that overlap and were apart begin an impact, whose closing speed is this rate (0 where the
 * rate is negative); an impact goes on; bodies that no longer overlap end it, as do komodromos, elastoplastic and
 * backfill at the state where their force has come down to zero. `contact->touching` tells what happened. */
PND_API int pnd_accept(const pnd_law* law, double penetration, double rate, pnd_contact* contact);

/* The impact ends here. For a host that locates the separation; the others leave it to pnd_accept. With komodromos the
 * penetration that is left is added to the indentation, with the others what was crushed. PND_BAD_ARGUMENT: also while
 * no impact lasts. */
PND_API int pnd_separate(const pnd_law* law, double penetration, pnd_contact* contact);

/* ---- What a law gives for two free bodies ---- */

/* Result of pnd_collide: a free impact of two bodies. */
typedef struct pnd_free_impact {
  double restitution;      /* separation over closing speed [-] */
  double peak_force;       /* [N]; infinite for stereomechanical */
  double peak_penetration; /* [m] */
  double time_of_peak;     /* of the force, after the touch [s] */
  double duration;         /* from the touch until the force is gone for good [s] */
  double impulse;          /* [N s] */
  double energy_lost;      /* [J] */
} pnd_free_impact;

/* Two free bodies of this reduced mass m1 m2/(m1 + m2) [kg] collide at this closing speed [m/s], both > 0: closed forms
 * where the law has them, else integrated to 1e-10. */
PND_API int pnd_collide(const pnd_law* law, double reduced_mass, double closing_speed, pnd_free_impact* result);

/* ---- What there is, for user interfaces. Texts live as long as the library. ---- */

/* Description of a law, as it is before one is made. */
typedef struct pnd_law_info {
  const char *name, *force, *summary, *source; /* "hertz", "F = k d^n", ... */
  size_t parameters, formulas;                 /* how many of each; no formulas: no damping to calibrate */
  int may_pull;                                /* 1: may pull near the separation, as published */
  int leaves_indentation;                      /* 1: what is left at zero force is added to the gap */
  int instantaneous; /* 1: a jump of the velocity, v+ = -restitution v-; the force is always 0 */
} pnd_law_info;

/* Whether a parameter must be given. */
enum pnd_need {
  PND_REQUIRED = 0,
  PND_OPTIONAL = 1,
  PND_DAMPING = 2, /* exactly one of those marked so */
  PND_TOGETHER = 3 /* all of those marked so, and then no other parameter */
};

/* One parameter of a law. */
typedef struct pnd_parameter_info {
  const char* name;
  const char* unit; /* SI; "" without dimension; n in "N/m^n" is the law's exponent */
  const char* meaning;
  double typical; /* of floors of concrete buildings */
  int need;       /* a pnd_need */
} pnd_parameter_info;

/* One way from a restitution to the damping. */
typedef struct pnd_formula_info {
  const char *name, *source, *note;
} pnd_formula_info;

/* Laws, parameters and formulas are counted from 0; PND_BAD_ARGUMENT: an index that does not exist. */
PND_API size_t pnd_law_count(void);
/* The index of a law; PND_BAD_ARGUMENT with the nearest name. */
PND_API int pnd_find_law(const char* name, size_t* law);
/* Description of the law with this index. */
PND_API int pnd_describe_law(size_t law, pnd_law_info* info);
/* All that pnd_create takes: the law's own parameters, then restitution, impact_velocity and reduced_mass as it has
 * them. */
PND_API int pnd_describe_parameter(size_t law, size_t parameter, pnd_parameter_info* info);
/* "exact" first. */
PND_API int pnd_describe_formula(size_t law, size_t formula, pnd_formula_info* info);

/* ---- Laws of yielding: storeys, hinges, isolators, soil ----
 *
 *     const pnd_value steel[] = {{"stiffness", 2e7}, {"yield_force", 1.5e5}, {"hardening", 0.02}};
 *     const pnd_word memory[] = {{"memory", "last"}};
 *     pnd_yielding *storey = NULL;
 *     if (pnd_create_yielding("menegotto_pinto", steel, 3, memory, 1, &storey) != PND_OK) puts(pnd_error_text());
 *     pnd_follow(storey, drift, n, force, tangent, lost);
 *     pnd_destroy_yielding(storey);
 *
 * The force pulls back: it has the sign of the deformation while nothing has yielded. SI units; of a hinge a
 * deformation is a rotation [rad] and a force a moment [N m]. */

/* A checked law of yielding with its parameters. It never changes. */
typedef struct pnd_yielding pnd_yielding;

/* A parameter that is one of some words. */
typedef struct pnd_word {
  const char *name, *word;
} pnd_word;

/* Makes the law of this name, which pnd_destroy_yielding must end. Values and words are its own parameters, each at
 * most once; NULL and 0 are no words. PND_BAD_ARGUMENT: an unknown law, parameter or word (the text names the nearest
 * one), a parameter that is missing, a value outside its range. *made is NULL then. */
PND_API int pnd_create_yielding(const char* law, const pnd_value* values, size_t count, const pnd_word* words,
                                size_t word_count, pnd_yielding** made);
/* NULL is allowed. */
PND_API void pnd_destroy_yielding(pnd_yielding* law);

/* The law along `count` deformations [m], each reached straight from the one before, the first from the undeformed
 * state: force [N], tangent [N/m], and energy lost until then [J], of `count` values each; NULL for what is not wanted.
 * The tangent at a turn or a corner is that on the way there. Ways are followed exactly: points between two turns
 * change nothing after them. */
PND_API int pnd_follow(const pnd_yielding* law, const double* deformation, size_t count, double* force, double* tangent,
                       double* lost);

/* Stiffness before anything has yielded [N/m], and the deformation that ductility is counted in [m]; NULL for what is
 * not wanted. */
PND_API int pnd_yielding_start(const pnd_yielding* law, double* stiffness, double* yield_deformation);

/* Description of a law of yielding. */
typedef struct pnd_yielding_info {
  const char *name, *force, *summary, *source;
  size_t parameters, choices; /* how many of each; choices are parameters that take a word */
} pnd_yielding_info;

/* A parameter that takes a word, with one of its words; the first one is taken where none is given. */
typedef struct pnd_choice_info {
  const char *name, *meaning, *word;
  size_t words; /* how many there are */
} pnd_choice_info;

/* Laws of yielding, their parameters, choices and words are counted from 0; PND_BAD_ARGUMENT: an index that does not
 * exist. */
PND_API size_t pnd_yielding_count(void);
PND_API int pnd_describe_yielding(size_t law, pnd_yielding_info* info);
/* `need` is PND_REQUIRED or PND_OPTIONAL. */
PND_API int pnd_describe_yielding_parameter(size_t law, size_t parameter, pnd_parameter_info* info);
PND_API int pnd_describe_yielding_choice(size_t law, size_t choice, size_t word, pnd_choice_info* info);

#ifdef __cplusplus
}
#endif

#endif
