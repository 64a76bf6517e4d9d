/* Contact laws and hysteretic laws for C, Fortran and other languages that can call C.
 *
 *     pnd_law *law = NULL;
 *     const pnd_value values[] = {{"stiffness", 2.75e9}, {"restitution", 0.65}, {"reduced_mass", 6e4}};
 *     pnd_contact contact = {0};
 *     pnd_response answer;
 *     if (pnd_create("jankowski", "exact", values, 3, &law) != PND_OK) puts(pnd_error_text());
 *
 *     pnd_respond(law, &contact, penetration, rate, &answer);    // any number of times: modifies nothing
 *     pnd_accept(law, penetration, rate, &contact);              // once per accepted step
 *     pnd_destroy(law);
 *
 * Signs: penetration [m] > 0 is overlap (the negative opening of the gap), rate [m/s] > 0 is closing, force [N] > 0
 * pushes the bodies apart. SI units.
 *
 * Errors: a function that returns a status returns PND_OK or another pnd_status. A failed function modifies nothing.
 * pnd_error_text() returns the last error text of the calling thread. Null pointers are reported as errors.
 *
 * Threads: all functions are thread-safe. A law is immutable after pnd_create, so threads may share it; a pnd_contact
 * belongs to the caller. The only other state is one error text per thread.
 *
 * Binary interface: functions, types and constants of PND_INTERFACE n do not change in later libraries with the same n,
 * which is the n of libpounding_c.so.n. Functions, status values, needs, laws and parameters may be added.
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
/* Version of the library at run time, such as "0.3.0". Valid for the lifetime of the library. */
PND_API const char* pnd_version(void);

/* ---- Errors ---- */

/* Return values of functions. */
enum pnd_status {
  PND_OK = 0,
  PND_BAD_ARGUMENT = 1, /* unknown name, invalid value or null pointer; the error text states what is allowed */
  PND_OUT_OF_MEMORY = 2,
  PND_FAILED = 3 /* a calculation that did not converge */
};

/* Error text of the last failed call of this thread, at most 511 bytes; "" before the first failure. Valid until the
 * next failure of this thread. */
PND_API const char* pnd_error_text(void);

/* ---- Laws ---- */

/* A validated law with its parameters. */
typedef struct pnd_law pnd_law;

/* A named parameter value. */
typedef struct pnd_value {
  const char* name;
  double value; /* in the unit of the parameter, see pnd_describe_parameter */
} pnd_value;

/* Creates the law of this name; release it with pnd_destroy. Values are the law's own parameters, plus restitution
 * [-], impact_velocity [m/s] and reduced_mass [kg] if the law takes them. Each may be given at most once. A law that
 * needs no mass ignores reduced_mass. A parameter that is a list is given item by item, as {"force[1]", 1e6},
 * {"force[2]", 8e6}; its plain name sets a list of one item. `formula` selects how the damping follows from the
 * restitution: "exact" or a published formula of the law; NULL and "" mean "exact". Returns PND_BAD_ARGUMENT, with
 * *made set to NULL, for an unknown law, formula or parameter (the text suggests the nearest name), for a missing
 * parameter, a value out of range, and damping that is given twice or not at all. */
PND_API int pnd_create(const char* law, const char* formula, const pnd_value* values, size_t count, pnd_law** made);
/* Releases a law; NULL is allowed. */
PND_API void pnd_destroy(pnd_law* law);

/* ---- An impact ---- */

/* Impact history of a link. All zeros: two bodies that have never touched. If the bodies are pressed together from the
 * start, call pnd_accept for that state with rate 0, and give the law an impact_velocity if it takes one. All members
 * are doubles, so that a host program can store them among its own state variables. To undo a step, restore a copy. */
typedef struct pnd_contact {
  double touching;      /* 1 during an impact, else 0 */
  double indentation;   /* added to the gap by komodromos, elastoplastic, backfill and elastic_plastic_gap; subtracted
                           from every penetration
                           [m] */
  double closing_speed; /* of this impact, or the fixed design velocity [m/s] */
  double damping;       /* coefficient of the law for this impact, in the law's own unit */
  double largest_penetration; /* maximum in this impact so far [m] */
  double slip;                /* plastic slip of bilinear_hertz, and of elastic_plastic_gap without damage [m] */
  double crushed;             /* maximum penetration in earlier impacts, for laws that crush [m] */
  double reserved[1];         /* must be zero */
} pnd_contact;
#define PND_CONTACT_DOUBLES 8

/* Response of a law to a state: the force and its two derivatives. */
typedef struct pnd_response {
  double force;          /* [N] */
  double by_penetration; /* derivative dF/dd [N/m] */
  double by_rate;        /* derivative dF/dd' [N s/m] */
} pnd_response;

/* Begins an impact at this closing speed >= 0 [m/s], which determines the damping. For host programs that locate the
 * instant of touch; they then call pnd_accept for the accepted states in which the bodies overlap. Other programs need
 * only pnd_accept. Returns PND_BAD_ARGUMENT also during an impact. */
PND_API int pnd_touch(const pnd_law* law, double closing_speed, pnd_contact* contact);

/* Force and derivatives at a state; zero unless the bodies overlap during an impact. Does not modify the contact. Only
 * kelvin_voigt can pull. */
PND_API int pnd_respond(const pnd_law* law, const pnd_contact* contact, double penetration, double rate,
                        pnd_response* response);

/* Updates the history with an accepted state. If the bodies overlap and were apart, an impact begins with this rate as
 * its closing speed (0 if the rate is negative). If they no longer overlap, the impact ends. With komodromos,
 * elastoplastic, backfill and elastic_plastic_gap with damage it also ends at the state in which the force has returned
 * to zero. `contact->touching` is
 * 1 if an impact is in progress. */
PND_API int pnd_accept(const pnd_law* law, double penetration, double rate, pnd_contact* contact);

/* Ends the impact. For host programs that locate the separation; other programs need only pnd_accept. The indentation
 * grows by the remaining penetration (komodromos) or by the crushed depth (elastoplastic, backfill,
 * elastic_plastic_gap). Returns
 * PND_BAD_ARGUMENT also if no impact is in progress. */
PND_API int pnd_separate(const pnd_law* law, double penetration, pnd_contact* contact);

/* ---- Free impact of two bodies ---- */

/* Result of pnd_collide: a free impact of two bodies. */
typedef struct pnd_free_impact {
  double restitution;      /* ratio of separation speed to closing speed [-] */
  double peak_force;       /* [N]; infinite for stereomechanical */
  double peak_penetration; /* [m] */
  double time_of_peak;     /* time of the peak force, from the touch [s] */
  double duration;         /* from the touch until the final release of the force [s] */
  double impulse;          /* [N s] */
  double energy_lost;      /* [J] */
} pnd_free_impact;

/* Computes the impact of two free bodies with this reduced mass m1 m2/(m1 + m2) [kg] and closing speed [m/s]; both
 * must be positive. Uses closed forms if the law has them, otherwise integration with tolerance 1e-10. */
PND_API int pnd_collide(const pnd_law* law, double reduced_mass, double closing_speed, pnd_free_impact* result);

/* ---- Catalogue of laws, for user interfaces. Texts are valid for the lifetime of the library. ---- */

/* Description of a law of the catalogue. */
typedef struct pnd_law_info {
  const char *name, *force, *summary, *source; /* "hertz", "F = k d^n", ... */
  size_t parameters, formulas;                 /* number of each; a law without formulas has no damping to calibrate */
  int may_pull;                                /* 1: may pull near the separation, as published */
  int leaves_indentation;                      /* 1: the penetration left at zero force is added to the gap */
  int instantaneous;                           /* 1: the velocity jumps, v+ = -restitution v-; the force is always 0 */
} pnd_law_info;

/* Whether a parameter is required. */
enum pnd_need {
  PND_REQUIRED = 0,
  PND_OPTIONAL = 1,
  PND_DAMPING = 2, /* exactly one parameter of this kind is required */
  PND_TOGETHER = 3 /* all parameters of this kind together, without any other parameter */
};

/* A parameter of a law. */
typedef struct pnd_parameter_info {
  const char* name;
  const char* unit; /* SI; "" if dimensionless; n in "N/m^n" is the exponent of the law */
  const char* meaning;
  double typical; /* typical of concrete floors */
  int need;       /* a pnd_need */
} pnd_parameter_info;

/* A formula that computes the damping from the restitution. */
typedef struct pnd_formula_info {
  const char *name, *source, *note;
} pnd_formula_info;

/* Indices of laws, parameters and formulas start at 0. An index out of range returns PND_BAD_ARGUMENT. */
PND_API size_t pnd_law_count(void);
/* Index of a law. For an unknown name returns PND_BAD_ARGUMENT, with the nearest name in the error text. */
PND_API int pnd_find_law(const char* name, size_t* law);
/* Description of the law at this index. */
PND_API int pnd_describe_law(size_t law, pnd_law_info* info);
/* Parameters that pnd_create accepts: the law's own parameters, then restitution, impact_velocity and reduced_mass if
 * the law takes them. */
PND_API int pnd_describe_parameter(size_t law, size_t parameter, pnd_parameter_info* info);
/* Formulas of a law; the first is "exact". */
PND_API int pnd_describe_formula(size_t law, size_t formula, pnd_formula_info* info);

/* ---- Hysteretic laws: storeys, hinges, isolators, soil ----
 *
 *     const pnd_value steel[] = {{"stiffness", 2e7}, {"yield_force", 1.5e5}, {"hardening", 0.02}};
 *     const pnd_word memory[] = {{"memory", "last"}};
 *     pnd_yielding *storey = NULL;
 *     if (pnd_create_yielding("menegotto_pinto", steel, 3, memory, 1, &storey) != PND_OK) puts(pnd_error_text());
 *     pnd_follow(storey, drift, n, force, tangent, lost);
 *     pnd_destroy_yielding(storey);
 *
 * The force is a restoring force: it has the sign of the deformation until first yield. SI units. For a hinge the
 * deformation is a rotation [rad] and the force a moment [N m]. */

/* A validated hysteretic law with its parameters. Immutable. */
typedef struct pnd_yielding pnd_yielding;

/* A parameter that takes a keyword. */
typedef struct pnd_word {
  const char *name, *word;
} pnd_word;

/* Creates the hysteretic law of this name; release it with pnd_destroy_yielding. `values` and `words` are the law's
 * own parameters, each at most once; pass NULL and 0 for no keywords. Returns PND_BAD_ARGUMENT, with *made set to
 * NULL, for an unknown law, parameter or keyword (the text suggests the nearest name), for a missing parameter and for
 * a value out of range. */
PND_API int pnd_create_yielding(const char* law, const pnd_value* values, size_t count, const pnd_word* words,
                                size_t word_count, pnd_yielding** made);
/* Releases a law; NULL is allowed. */
PND_API void pnd_destroy_yielding(pnd_yielding* law);

/* Evaluates the law along `count` deformations [m], from the undeformed state. Each deformation is reached from the
 * previous one on a straight path. Fills force [N], tangent [N/m] and energy dissipated so far [J], arrays of `count`
 * values; NULL skips an array. At a reversal or corner, the tangent is that of the path leading to it. The path is
 * integrated exactly: intermediate points between two reversals do not change later results. */
PND_API int pnd_follow(const pnd_yielding* law, const double* deformation, size_t count, double* force, double* tangent,
                       double* lost);

/* Initial stiffness [N/m], of a restrainer when taut, and the yield deformation, to which ductility refers [m];
 * infinite for a restrainer without strength. NULL skips a value. */
PND_API int pnd_yielding_start(const pnd_yielding* law, double* stiffness, double* yield_deformation);

/* Description of a hysteretic law. */
typedef struct pnd_yielding_info {
  const char *name, *force, *summary, *source;
  size_t parameters, choices; /* number of each; choices are parameters that take a keyword */
} pnd_yielding_info;

/* A parameter that takes a keyword, with one of its keywords; the first keyword is the default. */
typedef struct pnd_choice_info {
  const char *name, *meaning, *word;
  size_t words; /* number of keywords */
} pnd_choice_info;

/* Indices of hysteretic laws, parameters, choices and keywords start at 0. An index out of range returns
 * PND_BAD_ARGUMENT. */
PND_API size_t pnd_yielding_count(void);
PND_API int pnd_describe_yielding(size_t law, pnd_yielding_info* info);
/* Parameter of a hysteretic law; `need` is PND_REQUIRED or PND_OPTIONAL. */
PND_API int pnd_describe_yielding_parameter(size_t law, size_t parameter, pnd_parameter_info* info);
PND_API int pnd_describe_yielding_choice(size_t law, size_t choice, size_t word, pnd_choice_info* info);

#ifdef __cplusplus
}
#endif

#endif
